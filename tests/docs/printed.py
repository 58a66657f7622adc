"""Whether a command prints the lines of a document, in order but possibly with others between; numbers to the digits shown."""
import re

NUMBER = r"[-−+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
PART = re.compile(rf"((?<![\w.])(?:{NUMBER} [-+] {NUMBER}j|{NUMBER})(?!\w))")
TIME = re.compile(rf"{NUMBER} (?:s|ms|us)\b")
DOTS = "..."

# Beyond nine digits machines round differently; what is smaller than this is rounding.
DIGITS, ZERO = 1e-9, 1e-12


def parts(line):
    """The words and numbers of a line, alternating."""
    line = "time" if line.split()[:1] == ["time"] else TIME.sub("some time", line)
    pieces = PART.split(line)
    return [" ".join(words.split()) for words in pieces[::2]], pieces[1::2]


def last_digit(number):
    """Value of one unit of the last digit that is shown; an integer is a count."""
    mantissa, _, exponent = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals) if decimals else 0.0


def real_and_imaginary(number):
    return re.findall(NUMBER, number.replace(" ", "").replace("−", "-"))


def same_number(shown, printed):
    shown, printed = real_and_imaginary(shown), real_and_imaginary(printed)
    noise = max(DIGITS * max(abs(float(part)) for part in printed), ZERO)
    return len(shown) == len(printed) and all(abs(float(a) - float(b)) <= max(1.01 * last_digit(a), noise)
                                              for a, b in zip(shown, printed))


def same_line(shown, printed):
    (words, numbers), (other_words, other_numbers) = parts(shown), parts(printed)
    return words == other_words and all(map(same_number, numbers, other_numbers))


def first_missing(shown, printed):
    """The first line of a document that the command does not print behind those before it; None: all are there."""
    rest = iter([line for line in printed if line.strip()])
    for line in shown:
        if line.strip() != DOTS and not any(same_line(line, candidate) for candidate in rest):
            return line
    return None
