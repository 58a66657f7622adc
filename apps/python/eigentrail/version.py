"""The version of the reader, equal to that of the program."""

__version__ = "0.1.0"
