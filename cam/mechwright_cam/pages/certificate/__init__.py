"""Certificates: what makes it cheap to check a program without any code of this project."""

from mechwright_cam.pages.certificate.page import Certificates

__all__ = ["Certificates"]
