/* SPDX-License-Identifier: MIT */
/// @file
/// Giving up some of what the refined axes' sums know. See hinge/forget.h.
#include "hinge/forget.h"

#include "hinge/block.h"
#include "hinge/model.h"
#include "math/scalar.h"
#include "math/sym.h"

#define TILTS JCAL_HINGE_TILTS
#define UNKNOWNS JCAL_HINGE_UNKNOWNS

/// Nothing at all is known below this: its reciprocal is finite.
#define PIVOT_MIN 1e-20f

/// What says how well the residuals are known, not what they say.
static void fade_counts(jcal_hinge_refine_t *self, float share)
{
    self->cost *= share;
    self->joint *= share;
    self->across *= share;
    self->alike.scale *= share;
    self->alike.lag *= share;
    self->alike.change *= share;
    self->blocks *= share;
    self->time_s *= share;
    self->same *= share;
    self->other *= share;
    self->sign_time_s *= share;
}

void jcal_hinge_refine_fade(jcal_hinge_refine_t *self, float share)
{
    jcal_sym_scale(self->matrix, UNKNOWNS, share);
    jcal_sym_scale(self->scatter, TILTS, share);
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        self->gradient[i] *= share;
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        self->lean[i] *= share;
    }
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        self->along[axis] *= share;
        self->told[axis] *= share;
        self->told2[axis] *= share;
    }
    self->information *= share;
    self->information2 *= share;
    fade_counts(self, share);
}

/// Eliminates a share 1 - keep of unknown p from matrix and gradient; keep = 0 leaves the information about the others alone.
///
/// What is left of row p is `keep` of it, exactly: as a difference it would be rounding, and the next time that this is given up,
/// rounding over rounding would be taken off the others.
static void eliminate(jcal_hinge_refine_t *self, unsigned p, float keep)
{
    const float pivot = self->matrix[jcal_sym_at(p, p)];
    const float give = (pivot > PIVOT_MIN) ? ((1.0f - keep) / pivot) : 0.0f;
    float column[UNKNOWNS];
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        column[i] = self->matrix[jcal_sym_at(i, p)];
    }
    const float of_p = self->gradient[p];
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        const float share = give * column[i];
        for (unsigned k = 0u; k <= i; ++k) {
            self->matrix[jcal_sym_at(i, k)] -= share * column[k];
        }
        const size_t own = jcal_sym_at(i, i);
        self->matrix[own] = jcal_max(self->matrix[own], 0.0f); /* where all was owed to p, rounding is left */
        self->gradient[i] -= share * of_p;
    }
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        self->matrix[jcal_sym_at(i, p)] = keep * column[i];
    }
    self->gradient[p] = keep * of_p;
}

void jcal_hinge_refine_forget_axis(jcal_hinge_refine_t *self, unsigned axis, float keep)
{
    const unsigned first = 2u * axis;
    for (unsigned i = 0u; i < TILTS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            const bool touches = ((i / 2u) == axis) || ((k / 2u) == axis);
            self->scatter[jcal_sym_at(i, k)] *= touches ? keep : 1.0f;
        }
    }
    for (unsigned i = first; i < (first + 2u); ++i) {
        eliminate(self, i, keep);
        self->lean[i] *= keep;
    }
    self->along[axis] *= keep;
    self->told[axis] *= keep;
    self->told2[axis] *= keep;
}

void jcal_hinge_refine_forget(jcal_hinge_refine_t *self, unsigned axis, float keep)
{
    jcal_hinge_refine_forget_axis(self, axis, keep);
    self->information *= keep;
    self->information2 *= keep;
    fade_counts(self, keep);
}
