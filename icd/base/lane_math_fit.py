#!/usr/bin/env python3
"""Makes the polynomial coefficients of lane_math (needs mpmath).

Weighted least squares on Chebyshev points, which comes within a few tenths of a bit of the minimax polynomial.
Coefficients are rounded to float32 or float64 one after the other, lowest degree first; the rest is fitted again, so that
it makes up for the rounding. Prints each list and the largest weighted error, which is relative to the function's value.
"""
import struct

from mpmath import mp, mpf, matrix, lu_solve, cos, sin, tan, asin, atan, exp, log, log1p, pi, sqrt

mp.prec = 200


def rounded(x, bits):
    code = "<f" if bits == 32 else "<d"
    return mpf(struct.unpack(code, struct.pack(code, float(x)))[0])


def fit(name, function, weight, low, high, count, bits=32, points=160):
    """Polynomial of `count` coefficients in u over [low, high]; the error is weighted by weight(u)."""
    nodes = [(low + high) / 2 + (high - low) / 2 * cos(pi * (2 * i + 1) / (2 * points)) for i in range(points)]
    weights = [weight(u) for u in nodes]
    rest = [function(u) for u in nodes]
    fixed = []
    for first in range(count):
        size = count - first
        normal, right = matrix(size, size), matrix(size, 1)
        for u, w, f in zip(nodes, weights, rest):
            row = [w * u ** (first + i) for i in range(size)]
            for i in range(size):
                right[i] += row[i] * w * f
                for j in range(size):
                    normal[i, j] += row[i] * row[j]
        c = rounded(lu_solve(normal, right)[0], bits)
        fixed.append(c)
        rest = [f - c * u**first for u, f in zip(nodes, rest)]
    error = max(abs(w * f) for w, f in zip(weights, rest))
    print(f"{name}: error 2^{float(log(error, 2)):.1f}")
    print("  " + ", ".join(float.hex(float(c)) for c in fixed))


def main():
    tiny = mpf(2) ** -40
    sin_max = (pi / 2 + mpf(2) ** -8) ** 2
    fit("sin", lambda u: (sin(sqrt(u)) / sqrt(u) - 1) / u, lambda u: u / (sin(sqrt(u)) / sqrt(u)), tiny, sin_max, 5)
    u_max = (pi / 4 + mpf(2) ** -8) ** 2
    odd = lambda f: (lambda u: (f(sqrt(u)) / sqrt(u) - 1) / u)
    weight = lambda f: (lambda u: u / (f(sqrt(u)) / sqrt(u)))
    fit("tan", odd(tan), weight(tan), tiny, u_max, 7)
    fit("asin", odd(asin), weight(asin), tiny, mpf("0.25"), 6)
    fit("atan", odd(atan), weight(atan), tiny, mpf(1), 9)
    half = log(2) / 2 + mpf(2) ** -12
    fit("exp", lambda r: (exp(r) - 1 - r) / r**2, lambda r: r**2 / exp(r), -half, half, 5)
    fit("exp2", lambda r: (mpf(2) ** r - 1) / r, lambda r: abs(r) / mpf(2) ** r, -mpf("0.5"), mpf("0.5"), 6)
    low, high = sqrt(mpf("0.5")) - 1, sqrt(mpf(2)) - 1
    fit("log", lambda f: (log1p(f) - f + f**2 / 2) / f**3, lambda f: abs(f**3 / log1p(f)), low, high, 9)
    fit("exp2, double", lambda r: mpf(2) ** r, lambda r: 1 / mpf(2) ** r, -mpf("0.5"), mpf("0.5"), 9, 64)
    s_max = (sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1) + mpf(2) ** -20
    log2_ratio = lambda u: log((1 + sqrt(u)) / (1 - sqrt(u)), 2) / sqrt(u)
    s_max = (sqrt(mpf(2)) - 1) / (sqrt(mpf(2)) + 1) + mpf(2) ** -12
    fit("log2 in two floats, after 2 / ln 2", lambda u: (log2_ratio(u) - 2 / log(2)) / u, lambda u: u / log2_ratio(u),
        tiny, s_max**2, 4)
    fit("log2, double", log2_ratio, lambda u: 1 / log2_ratio(u), tiny, s_max**2, 6, 64)


main()
