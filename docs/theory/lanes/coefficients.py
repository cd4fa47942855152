"""The constants of src/lanes/functions.rs: the Rust literals that stand there, in their order.

Needs mpmath only: `python3 docs/theory/lanes/coefficients.py`.

Polynomials are fitted by the Remez exchange on a dense Chebyshev grid, with a weight that makes the
relative error of the function itself the one that is least, not that of the polynomial. The
coefficients are rounded to float64 one at a time, lowest power first; after each the remaining ones
are fitted again, and so take up what the rounding left.
"""

from mpmath import atan, cos, floor, frexp, ldexp, log, lu_solve, matrix, mp, mpf, pi, sin, sqrt

mp.prec = 240

EXCHANGES = 40
POINTS_A_COEFFICIENT = 20
LEVEL = mpf("1.001")  # a largest error this close to the leveled one is the least there is


def rounded(value):
    """The nearest double."""
    return mpf(float(value))


def horner(coefficients, u):
    """A polynomial by ascending powers."""
    value = mpf(0)
    for coefficient in reversed(coefficients):
        value = value * u + coefficient
    return value


def leveled(us, fs, weights, shift, count, reference):
    """Coefficients whose weighted error at the reference is equal, in turn up and down; and that
    error.
    """
    system, right = matrix(count + 1, count + 1), matrix(count + 1, 1)
    for i, j in enumerate(reference):
        power = us[j] ** shift
        for k in range(count):
            system[i, k] = power
            power *= us[j]
        system[i, count] = (-1) ** i / weights[j]
        right[i] = fs[j]
    solution = lu_solve(system, right)
    return [solution[k] for k in range(count)], abs(solution[count])


def extremes(errors):
    """The place of the largest error of each run of equal sign."""
    places, start = [], 0
    for j in range(1, len(errors) + 1):
        if j == len(errors) or (errors[j] > 0) != (errors[start] > 0):
            places.append(max(range(start, j), key=lambda i: abs(errors[i])))
            start = j
    return places


def remez(us, fs, weights, shift, count):
    """Coefficients c that make the largest |weight (f - u^shift sum c_k u^k)| of the grid least;
    first, that error.
    """
    grid = len(us)
    reference = [(2 * i + 1) * grid // (2 * (count + 1)) for i in range(count + 1)]
    best = (mpf("inf"), None)
    for _ in range(EXCHANGES):
        coefficients, level = leveled(us, fs, weights, shift, count, reference)
        errors = [
            w * (f - u**shift * horner(coefficients, u))
            for u, f, w in zip(us, fs, weights, strict=True)
        ]
        worst = max(abs(error) for error in errors)
        best = min(best, (worst, coefficients), key=lambda found: found[0])
        reference = extremes(errors)
        while len(reference) > count + 1:
            weaker_end = 0 if abs(errors[reference[0]]) < abs(errors[reference[-1]]) else -1
            reference.pop(weaker_end)
        if len(reference) < count + 1 or worst < level * LEVEL:
            break
    return best


def fit(function, weight, top, count):
    """Doubles c with `sum c_k u^k` next to the function on 0 .. top, and the largest weighted error
    that they leave.
    """
    grid = POINTS_A_COEFFICIENT * count
    us = [top * (1 - cos(pi * (mpf(i) + mpf(1) / 2) / grid)) / 2 for i in range(grid)] + [top]
    rest, weights = [function(u) for u in us], [weight(u) for u in us]
    done = []
    for k in range(count):
        done.append(rounded(remez(us, rest, weights, k, count - k)[1][0]))
        rest = [f - done[k] * u**k for f, u in zip(rest, us, strict=True)]
    return done, max(abs(w * f) for w, f in zip(weights, rest, strict=True))


def atan_ratio(u):
    """atan(t) / t, u = t^2."""
    return atan(sqrt(u)) / sqrt(u)


def sin_ratio(z):
    """sin(r) / r, z = r^2."""
    return sin(sqrt(z)) / sqrt(z)


def cos_of(z):
    """cos(r), z = r^2."""
    return cos(sqrt(z))


def truncated(value, bits):
    """The first bits of a number."""
    exponent = bits - frexp(value)[1]
    return ldexp(floor(ldexp(value, exponent)), -exponent)


def grouped(digits):
    """Digits in threes from the left, as behind a decimal point."""
    return "_".join(digits[i : i + 3] for i in range(0, len(digits), 3))


def literal(value):
    """A double as a Rust literal, digits in threes."""
    mantissa, _, exponent = repr(float(value)).partition("e")
    whole, _, decimals = mantissa.partition(".")
    if not exponent:
        return f"{whole}.{grouped(decimals)}"
    return f"{whole}{'.' if decimals else ''}{grouped(decimals)}e{int(exponent)}"


def show(name, values):
    """Prints constants under the name that they have in Rust."""
    print(name)
    for value in values:
        print(literal(value))


def show_fit(name, result):
    """Prints coefficients and the error that they leave."""
    coefficients, error = result
    show(f"{name}  # relative error 2^{float(log(error, 2)):.1f}", coefficients)


def main():
    """Prints all constants."""
    half_pi = rounded(pi / 2)
    show("PI_REST_RATIO", [rounded((pi / 2 - half_pi) / half_pi)])
    show_fit(
        "ATAN", fit(lambda u: (atan_ratio(u) - 1) / u, lambda u: u / atan_ratio(u), mpf(1), 20)
    )
    # A reduced angle may be beyond pi/4 by the rounding of the turn.
    top = (pi / 4 * (1 + mpf(2) ** -30)) ** 2
    show_fit("SIN", fit(lambda z: (sin_ratio(z) - 1) / z, lambda z: z / sin_ratio(z), top, 6))
    show_fit(
        "COS", fit(lambda z: (cos_of(z) - 1 + z / 2) / z**2, lambda z: z**2 / cos_of(z), top, 6)
    )
    first = truncated(pi / 2, 37)
    second = truncated(pi / 2 - first, 37)
    third = rounded(pi / 2 - first - second)
    off = abs(pi / 2 - first - second - third)
    show(f"PI_2_PARTS  # off by 2^{float(log(off, 2)):.1f}", [first, second, third])


if __name__ == "__main__":
    main()
