# SPDX-License-Identifier: Apache-2.0
"""Keys, certificates and signatures as the DDS Security standard asks for them."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import pkcs7

LIFE = timedelta(days=3650)
"""How long a certificate is valid."""

LEEWAY = timedelta(days=1)
"""A certificate is valid for hosts whose clock is behind by this much."""


@dataclass(frozen=True)
class Validity:
    """A span of time.

    Attributes:
        begin: first moment (UTC, whole seconds).
        end: last moment (UTC, whole seconds).

    """

    begin: datetime
    end: datetime


@dataclass(frozen=True)
class Identity:
    """A private key and the certificate that goes with it.

    Attributes:
        certificate: X.509 certificate.
        key: its private key, on the curve P-256.

    """

    certificate: x509.Certificate
    key: ec.EllipticCurvePrivateKey

    def certificate_pem(self) -> bytes:
        """Return the certificate as PEM."""
        return self.certificate.public_bytes(serialization.Encoding.PEM)

    def key_pem(self) -> bytes:
        """Return the private key as PEM, not encrypted: nodes start without a password."""
        return self.key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        )


def validity_from(now: datetime) -> Validity:
    """Return the validity of what is made now.

    Args:
        now: the present moment, with its time zone UTC.

    """
    second = now.replace(microsecond=0)
    return Validity(second - LEEWAY, second + LIFE)


def found_authority(name: str, validity: Validity) -> Identity:
    """Return a new authority, which certifies itself.

    Args:
        name: its common name.
        validity: when it is valid.

    """
    key = ec.generate_private_key(ec.SECP256R1())
    certificate = _certify(_named(name), key, _named(name), key, True, validity)
    return Identity(certificate, key)


def issue(authority: Identity, name: str, validity: Validity) -> Identity:
    """Return a new key that an authority certifies as that of `name`.

    Args:
        authority: who certifies it.
        name: common name.
        validity: when the certificate is valid.

    """
    key = ec.generate_private_key(ec.SECP256R1())
    issuer = authority.certificate.subject
    certificate = _certify(_named(name), key, issuer, authority.key, False, validity)
    return Identity(certificate, key)


def sign(authority: Identity, document: str) -> bytes:
    """Return a text with the signature of an authority, as S/MIME with the text in clear."""
    builder = (
        pkcs7.PKCS7SignatureBuilder()
        .set_data(document.encode())
        .add_signer(authority.certificate, authority.key, hashes.SHA256())
    )
    options = [pkcs7.PKCS7Options.Text, pkcs7.PKCS7Options.DetachedSignature]
    return builder.sign(serialization.Encoding.SMIME, options)


def _named(name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(x509.oid.NameOID.COMMON_NAME, name)])


def _certify(
    subject: x509.Name,
    key: ec.EllipticCurvePrivateKey,
    issuer: x509.Name,
    issuer_key: ec.EllipticCurvePrivateKey,
    authority: bool,
    validity: Validity,
) -> x509.Certificate:
    constraints = x509.BasicConstraints(authority, path_length=0 if authority else None)
    of_subject = x509.SubjectKeyIdentifier.from_public_key(key.public_key())
    of_issuer = x509.AuthorityKeyIdentifier.from_issuer_public_key(issuer_key.public_key())
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .public_key(key.public_key())
        .issuer_name(issuer)
        .serial_number(x509.random_serial_number())
        .not_valid_before(validity.begin)
        .not_valid_after(validity.end)
        .add_extension(constraints, critical=True)
        .add_extension(_usage(authority), critical=True)
        .add_extension(of_subject, critical=False)
        .add_extension(of_issuer, critical=False)
        .sign(issuer_key, hashes.SHA256())
    )


def _usage(authority: bool) -> x509.KeyUsage:
    """Return what a key is for: an authority certifies and signs, a node signs."""
    return x509.KeyUsage(
        digital_signature=True,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=authority,
        crl_sign=authority,
        encipher_only=False,
        decipher_only=False,
    )
