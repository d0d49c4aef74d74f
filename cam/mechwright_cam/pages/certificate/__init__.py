"""Certificates: what makes it cheap to check a program without any code of this project."""

from mechwright_cam.pages.certificate.page import CERTIFICATE, Certificates

__all__ = ["CERTIFICATE", "Certificates"]
