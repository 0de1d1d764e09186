"""Fits laws of growth to a quantity y that was measured at sizes x.

A term (power, logarithm) is x^power, times log2 x if logarithm is 1. A form is a tuple of terms, the leading one first. No fit
of sizes has an interval: residuals of sizes are no independent errors.
"""

import numpy as np
from kds._lifetimes import student_95
from scipy import optimize

# The forms that are compared if no theorem names one.
USUAL_FORMS = (((0, 0),), ((0, 1),), ((0, 1), (0, 0)), ((1, 0),), ((1, 0), (0, 0)), ((1, 1),), ((1, 1), (1, 0)),
               ((4 / 3, 0),), ((4 / 3, 0), (1, 0)), ((2, 0),), ((2, 0), (1, 0)))


def values(form, x):
    """Returns the terms of a form at each x as columns."""
    return np.stack([x**power * np.log2(x)**logarithm for power, logarithm in form], axis=1)


def least_squares(form, x, y):
    """Fits y = sum of coefficients * terms. Returns the coefficients and the sum of the squared relative residuals."""
    shares = values(form, x) / y[:, None]
    scale = np.linalg.norm(shares, axis=0)
    solution = np.linalg.lstsq(shares / scale, np.ones(len(x)), rcond=None)[0]
    return solution / scale, float(np.sum((shares / scale @ solution - 1)**2))


def sizes(points):
    """Returns x and y in ascending order of x, with the mean of the points of each x."""
    x = sorted({one for one, _ in points})
    return np.array(x, float), np.array([np.mean([y for at, y in points if at == one]) for one in x])


def line(points):
    """Returns exponent and factor of the power law through the logarithms, or None for fewer than three positive points."""
    logs = np.log2([point for point in points if min(point) > 0])
    if len(logs) < 3 or np.ptp(logs[:, 0]) == 0:
        return None
    slope, height = np.polyfit(*logs.T, 1)
    return float(slope), float(2**height)


def jackknife(points, without):
    """Returns the exponent of the power law and the half width of its 95% interval. Each element of `without` has the points
    as they are when one of several equal, independent shares of the measurements is left out."""
    fits = [line(points), *map(line, without)]
    if None in fits or len(without) < 2:
        return None
    others = np.array([exponent for exponent, _ in fits[1:]])
    error = np.sqrt((len(without) - 1) * np.var(others))
    return fits[0][0], float(student_95(len(without) - 1) * error)


def mean_interval(seeds):
    """Returns mean and ends of Student's 95% interval, moved above 0, of independent values (equal values: no interval)."""
    mean, count = float(np.mean(seeds)), len(seeds)
    if count < 2 or mean <= 0 or np.ptp(seeds) == 0:
        return mean, None, None
    error = student_95(count - 1) * np.std(seeds, ddof=1) / np.sqrt(count)
    return mean, float(mean * np.exp(-error / mean)), float(mean * np.exp(error / mean))


def local_exponents(points):
    """Returns the slopes between neighbouring sizes, both axes logarithmic."""
    x, y = sizes(points)
    return np.diff(np.log(y)) / np.diff(np.log(x)) if min(y) > 0 else np.array([])


def exponent(points, lower, logarithm=0):
    """Returns the exponent of the leading term beside lower-order terms, at most two above the first of them, or None unless
    there are four more sizes than lower terms."""
    x, y = sizes(points)
    if len(x) < len(lower) + 4 or min(y) <= 0:
        return None
    least = lower[0][0] + (0 if lower[0][1] != logarithm else 1e-6)

    def squares(power):
        return least_squares(((power, logarithm), *lower), x, y)[1]

    powers = least + np.linspace(0, 2, 401)
    best = int(np.argmin([squares(power) for power in powers]))
    between = powers[max(best - 1, 0)], powers[min(best + 1, 400)]
    return float(optimize.minimize_scalar(squares, bounds=between, method="bounded", options={"xatol": 1e-10}).x)


def fit(form, points):
    """Returns coefficients, AICc, largest relative residual and the error of the prediction of the largest size from the
    others, or None if the form does not fit: it needs three more sizes than terms, and positive values."""
    x, y = sizes(points)
    parameters = len(form) + 1
    if min(x) <= 0 or min(y) <= 0 or len(x) < parameters + 2:
        return None
    found, squares = least_squares(form, x, y)
    fitted = values(form, x) @ found
    if found[0] <= 0 or min(fitted) <= 0:
        return None
    aicc = (len(x) * np.log(max(squares / len(x), 1e-24)) + 2 * parameters
            + 2 * parameters * (parameters + 1) / (len(x) - parameters - 1))
    predicted = values(form, x[-1:]) @ least_squares(form, x[:-1], y[:-1])[0]
    return found, aicc, float(max(abs(y / fitted - 1))), float(predicted[0] / y[-1] - 1)


def law(points, forms=USUAL_FORMS, size="n"):
    """Returns the form with the least AICc in words, its largest residual, and the error of its prediction of the largest
    size, or None."""
    fits = [(found[1], form, found) for form in forms if (found := fit(form, points)) is not None]
    if not fits:
        return None
    _, form, (coefficients, _, residual, prediction) = min(fits, key=lambda one: one[0])
    words = ""
    for coefficient, (power, logarithm) in zip(coefficients, form):
        sign = "" if not words else " - " if coefficient < 0 else " + "
        words += f"{sign}{abs(coefficient) if words else coefficient:.4g}"
        if power not in (0, 1):
            is_third = power % 1 and abs(3 * power - round(3 * power)) < 1e-9
            words += f" {size}^({round(3 * power)}/3)" if is_third else f" {size}^{power:g}"
        words += f" {size}" if power == 1 else ""
        words += f" log2 {size}" if logarithm else ""
    return words, residual, prediction


def growth(points, lower, forms=USUAL_FORMS, logarithm=0, size="n"):
    """Returns all fits to one quantity as a row: the straight line, the last local exponent, the exponent beside lower-order
    terms, and the law."""
    through = line([(x, y / np.log2(x) if logarithm else y) for x, y in zip(*sizes(points))])
    local, found = local_exponents(points), law(points, forms, size)
    return {"line": through and through[0], "last": float(local[-1]) if len(local) else None,
            "exponent": exponent(points, lower, logarithm),
            **dict(zip(("law", "residual_most", "prediction_error"), found or (None, None, None)))}
