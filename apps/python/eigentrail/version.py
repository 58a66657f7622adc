"""The version of the reader is that of the program."""

__version__ = "0.1.0"
