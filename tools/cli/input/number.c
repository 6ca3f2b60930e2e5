/* SPDX-License-Identifier: MIT */
/* Numbers from text. */
#include "input/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A decimal number in its parts: sign, digits with a point somewhere, exponent. */
typedef struct {
    bool negative;
    const char *digits; /* digits and at most one point */
    long whole;         /* digits before the point */
    long exponent;
} decimal_t;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* The exponent after 'e', limited to what can matter; false if there are no digits. */
static bool scan_exponent(const char **text, long *exponent)
{
    const char *at = *text;
    const bool negative = *at == '-';
    if (*at == '-' || *at == '+') {
        at++;
    }
    if (!is_digit(*at)) {
        return false;
    }
    long value = 0;
    for (; is_digit(*at); at++) {
        /* A row holds a million digits at most; a larger exponent is zero or infinity whatever the digits are. */
        if (value < 10000000) {
            value = 10 * value + (*at - '0');
        }
    }
    *exponent = negative ? -value : value;
    *text = at;
    return true;
}

/* Takes a decimal number apart; false if the text is anything else. */
static bool scan_decimal(const char *text, decimal_t *decimal)
{
    const char *at = text;
    *decimal = (decimal_t){.negative = *at == '-'};
    if (*at == '-' || *at == '+') {
        at++;
    }
    decimal->digits = at;
    for (; is_digit(*at); at++) {
        decimal->whole++;
    }
    long fraction = 0;
    if (*at == '.') {
        for (at++; is_digit(*at); at++) {
            fraction++;
        }
    }
    if (decimal->whole + fraction == 0) {
        return false;
    }
    if (*at == 'e' || *at == 'E') {
        at++;
        if (!scan_exponent(&at, &decimal->exponent)) {
            return false;
        }
    }
    return *at == '\0';
}

/* True for nothing, nan and inf in their usual spellings. */
static bool is_not_finite(const char *text)
{
    static const char *const names[] = {"nan", "inf", "infinity"};
    if (*text == '\0') {
        return true;
    }
    const char *name = (*text == '-' || *text == '+') ? text + 1 : text;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        if (strcasecmp(name, names[k]) == 0) {
            return true;
        }
    }
    return false;
}

number_kind_t number_to_float(const char *text, float *value)
{
    decimal_t decimal;
    if (scan_decimal(text, &decimal)) {
        /* strtof follows the locale, and this program leaves that at "C". */
        *value = strtof(text, NULL);
        return isfinite(*value) ? NUMBER_FINITE : NUMBER_NOT_FINITE;
    }
    if (is_not_finite(text)) {
        *value = NAN;
        return NUMBER_NOT_FINITE;
    }
    return NUMBER_NOT_A_NUMBER;
}

/* Appends a digit; false if the value would become too large. */
static bool append_digit(int64_t *us, int digit)
{
    if (*us > (NUMBER_US_MAX - digit) / 10) {
        return false;
    }
    *us = 10 * *us + digit;
    return true;
}

/* |decimal| in microseconds without its fraction; `beyond` becomes the sign of (fraction - 1/2). False if too large. */
static bool whole_us(const decimal_t *decimal, int64_t *us, int *beyond)
{
    /* Power of ten of the current digit, in microseconds. */
    long power = decimal->whole - 1 + decimal->exponent + 6;
    *us = 0;
    *beyond = -1;
    for (const char *at = decimal->digits; is_digit(*at) || *at == '.'; at++) {
        if (*at == '.') {
            continue;
        }
        const int digit = *at - '0';
        if (power >= 0) {
            if (!append_digit(us, digit)) {
                return false;
            }
        } else if (power == -1) {
            *beyond = (digit > 5) - (digit < 5);
        } else if (digit > 0 && *beyond == 0) {
            *beyond = 1;
        }
        power--;
    }
    for (; power >= 0 && *us > 0; power--) {
        if (!append_digit(us, 0)) {
            return false;
        }
    }
    return true;
}

number_kind_t number_to_us(const char *text, int64_t *value)
{
    decimal_t decimal;
    if (!scan_decimal(text, &decimal)) {
        return is_not_finite(text) ? NUMBER_NOT_FINITE : NUMBER_NOT_A_NUMBER;
    }
    int64_t us;
    int beyond;
    if (!whole_us(&decimal, &us, &beyond)) {
        return NUMBER_NOT_FINITE;
    }
    if (decimal.negative) {
        *value = -us - (beyond > 0);
    } else {
        *value = us + (beyond >= 0);
    }
    return NUMBER_FINITE;
}
