"""Programs on their way to the machine: to a folder, to cncjs, to FluidNC.

Glossary
--------
proven program
    The files of a program and the certificate that they were held against, as bytes that were read once.
target
    Where programs go. It sends bytes, and reads them back: a program that arrived otherwise is an error.
"""
