/* SPDX-License-Identifier: MIT */
/// @file
/// Scores of [OLS20] (42)-(46) by rounds of 2n + 1 samples (the two-part window of van Herk, Gil and Werman).
#include "sample/select.h"

#include "jointcal/vec3.h"

#include <math.h>

/* The difference of smaller magnitude; the earlier one if they are equal. */
static float lesser(float earlier, float later)
{
    return (fabsf(later) < fabsf(earlier)) ? later : earlier;
}

static float smaller(float a, float b)
{
    return (a < b) ? a : b;
}

static void put(float *v, jcal_vec3_t a, jcal_vec3_t b)
{
    v[0] = a.x;
    v[1] = a.y;
    v[2] = a.z;
    v[3] = b.x;
    v[4] = b.y;
    v[5] = b.z;
}

static void fill_slot(jcal_score_slot_t *slot, const jcal_pair_t *pair, uint32_t id)
{
    const jcal_vec3_t w1 = pair->imu1.gyr_rad_s;
    const jcal_vec3_t w2 = pair->imu2.gyr_rad_s;
    put(slot->w, w1, w2);
    put(slot->a, pair->imu1.acc_m_s2, jcal_vec3_scale(pair->imu2.acc_m_s2, -1.0f));
    slot->least = jcal_vec3_norm(w1) - jcal_vec3_norm(w2); /* (42) */
    slot->energy1 = jcal_vec3_dot(w1, w1);
    slot->energy2 = jcal_vec3_dot(w2, w2);
    slot->id = id;
}

static void begin_round(jcal_score_t *self)
{
    self->pos = 0u;
    self->least = 0.0f;
    self->energy1 = 0.0f;
    self->energy2 = 0.0f;
}

/* A round is complete: minima and sums from each slot to the end of the round. */
static void finish_round(jcal_score_t *self, jcal_score_slot_t *slots, size_t length)
{
    for (size_t i = length - 1u; i > 0u; --i) {
        slots[i - 1u].least = lesser(slots[i - 1u].least, slots[i].least);
        slots[i - 1u].energy1 += slots[i].energy1;
        slots[i - 1u].energy2 += slots[i].energy2;
    }
    self->full = true;
    begin_round(self);
}

static void copy_row(jcal_row_t *row, float key, uint32_t id, const float *v)
{
    row->key = key;
    row->id = id;
    for (size_t k = 0u; k < 6u; ++k) {
        row->v[k] = v[k];
    }
}

/* The slot in the middle of the window that ends at `last`; its window is cut off if the ring was never full. */
static void score_centre(const jcal_score_t *self, const jcal_score_slot_t *slots, size_t last, jcal_scored_t *out)
{
    const size_t n = self->half_window;
    const size_t length = (2u * n) + 1u;
    const jcal_score_slot_t *const centre = &slots[(last + length - n) % length];
    float least = self->least;
    float energy1 = self->energy1;
    float energy2 = self->energy2;
    if (self->full && ((last + 1u) < length)) {
        const jcal_score_slot_t *const oldest = &slots[last + 1u];
        least = lesser(oldest->least, least); /* (44): the smallest magnitude, with its sign */
        energy1 += oldest->energy1;
        energy2 += oldest->energy2;
    }
    const bool complete = self->full || ((last + 1u) == length);
    /* (45), (46): mean energy of the calmer sensor. */
    const float penalty = complete ? (smaller(energy1, energy2) / (float)length) : JCAL_PENALTY_INFINITE;
    copy_row(&out->gyr, least, centre->id, centre->w);
    copy_row(&out->acc, smaller(penalty, JCAL_PENALTY_INFINITE), centre->id, centre->a);
}

void jcal_score_init(jcal_score_t *self, uint16_t half_window)
{
    self->half_window = half_window;
    jcal_score_restart(self);
}

void jcal_score_restart(jcal_score_t *self)
{
    self->full = false;
    begin_round(self);
}

bool jcal_score_push(jcal_score_t *self, jcal_score_slot_t *slots, const jcal_pair_t *pair, uint32_t id,
                     jcal_scored_t *out)
{
    const size_t length = (2u * (size_t)self->half_window) + 1u;
    const size_t last = self->pos;
    jcal_score_slot_t *const slot = &slots[last];
    fill_slot(slot, pair, id);
    self->least = (last == 0u) ? slot->least : lesser(self->least, slot->least);
    self->energy1 += slot->energy1;
    self->energy2 += slot->energy2;
    const bool ready = self->full || (last >= self->half_window);
    if (ready) {
        score_centre(self, slots, last, out);
    }
    self->pos = (uint16_t)(last + 1u);
    if (self->pos == length) {
        finish_round(self, slots, length);
    }
    return ready;
}
