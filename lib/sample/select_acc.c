/* SPDX-License-Identifier: MIT */
/// @file
/// Algorithm 3 of [OLS20]: slow rows that do not repeat what the others say. The rows are a heap by their penalty.
#include "sample/select.h"

#include "math/eig.h"
#include "math/sym.h"
#include "sample/heap.h"

enum { ROW = 6 }; /* elements of a row of A */

void jcal_select_acc_init(jcal_select_acc_t *self, uint32_t n_max, uint32_t acc_min, float energy_max)
{
    *self = (jcal_select_acc_t){0};
    self->capacity = n_max;
    self->acc_min = (acc_min < n_max) ? acc_min : n_max;
    self->energy_max = energy_max;
}

void jcal_select_acc_refresh(jcal_select_acc_t *self, const jcal_row_t *rows)
{
    jcal_sym_zero(self->ata, ROW);
    for (uint32_t k = 0u; k < self->count; ++k) {
        jcal_sym_rank1(self->ata, ROW, rows[k].v, 1.0f);
    }
}

static void insert(jcal_select_acc_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    jcal_heap_insert(rows, self->count, row);
    ++self->count;
    jcal_sym_rank1(self->ata, ROW, row->v, 1.0f);
}

static void remove_at(jcal_select_acc_t *self, jcal_row_t *rows, size_t at)
{
    jcal_sym_rank1(self->ata, ROW, rows[at].v, -1.0f);
    jcal_heap_remove(rows, self->count, at);
    --self->count;
}

static float dot(const float *a, const float *b)
{
    float sum = 0.0f;
    for (size_t k = 0u; k < ROW; ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}

/* w_1 of (50), unit: the top eigenvector of A^T A. The loop of Algorithm 3 makes the largest eigenvalues equal in
   the long
   run, where following the vector by power iteration would lag behind; so it is computed each time. */
static void top_direction(const jcal_select_acc_t *self, float top[ROW])
{
    float values[ROW];
    float vectors[ROW * ROW]; /* 6 x 6 */
    const bool done = jcal_eig_symmetric(self->ata, ROW, values, vectors);
    for (size_t k = 0u; k < ROW; ++k) {
        /* Without a direction (A is not finite) no row is coherent. */
        top[k] = done ? vectors[k] : 0.0f;
    }
}

/* Place of the row to remove: the largest penalty with c_k > 0.5, else the largest of all (the root). */
static size_t most_redundant(const jcal_select_acc_t *self, const jcal_row_t *rows)
{
    float top[ROW];
    top_direction(self, top);
    size_t worst = 0u;
    float penalty = -1.0f;
    for (uint32_t k = 0u; k < self->count; ++k) {
        if (rows[k].key > penalty) {
            /* (52) squared: c_k > 0.5, with |w_1| = 1. */
            const float along = dot(rows[k].v, top);
            if ((along * along) > (JCAL_COHERENT * JCAL_COHERENT * dot(rows[k].v, rows[k].v))) {
                worst = k;
                penalty = rows[k].key;
            }
        }
    }
    return worst;
}

void jcal_select_acc_offer(jcal_select_acc_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    insert(self, rows, row);
    if (self->seen < self->capacity) { /* N <= N_max: no selection */
        ++self->seen;
        return;
    }
    /* Line 3 of Algorithm 3. Every offer adds one row, so after the first time at most one goes. */
    uint32_t removed = 0u;
    while ((self->count > self->acc_min) && (rows[0].key > self->energy_max)) {
        remove_at(self, rows, 0u);
        ++removed;
    }
    if (removed > 1u) {
        jcal_select_acc_refresh(self, rows);
    }
    if (self->count > self->capacity) { /* lines 5 to 10 */
        remove_at(self, rows, most_redundant(self, rows));
    }
}
