/* SPDX-License-Identifier: MIT */
/* Host benchmark: jcal_bench FILE [REPEATS]. FILE holds jcal_pair_t records as tools/measure.py cost writes them.
   Writes one JSON object per engine. */
#include "jointcal/jointcal.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const uint64_t US_PER_S = 1000000u;
/* [OLS20] 7.3 tried 125 to 1000; here the number must be even. */
static const uint16_t N_MAX[] = {126u, 250u, 500u, 1000u};
#define N_MAX_COUNT (sizeof(N_MAX) / sizeof(N_MAX[0]))

typedef struct {
    jcal_pair_t *pairs;
    size_t count;
} data_t;

typedef union {
    jcal_hinge_t stream;
    jcal_hinge_window_t window;
} engine_t;

/* One engine with its buffers. */
typedef struct {
    bool is_window;
    jcal_hinge_window_config_t config;
    void *storage;
    size_t storage_bytes;
    engine_t engine;
} subject_t;

static double now_s(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool start(subject_t *self)
{
    if (self->is_window) {
        return jcal_hinge_window_init(&self->engine.window, &self->config, self->storage, self->storage_bytes) ==
               JCAL_OK;
    }
    return jcal_hinge_init(&self->engine.stream, &self->config.hinge) == JCAL_OK;
}

static void push(subject_t *self, const jcal_pair_t *pair)
{
    if (self->is_window) {
        (void)jcal_hinge_window_push(&self->engine.window, pair);
    } else {
        (void)jcal_hinge_push(&self->engine.stream, pair);
    }
}

static void step(subject_t *self)
{
    if (self->is_window) {
        (void)jcal_hinge_window_step(&self->engine.window);
    } else {
        (void)jcal_hinge_step(&self->engine.stream);
    }
}

static void get(const subject_t *self, jcal_hinge_result_t *result)
{
    if (self->is_window) {
        (void)jcal_hinge_window_get(&self->engine.window, result);
    } else {
        (void)jcal_hinge_get(&self->engine.stream, result);
    }
}

/* Seconds for the whole recording with one estimate per second of it, as an application would. Negative: the config or
   the count of samples was wrong. */
static double recording_s(subject_t *self, const data_t *data)
{
    jcal_hinge_result_t result;
    const double begin_s = now_s();
    if (!start(self)) {
        return -1.0;
    }
    uint64_t due_us = data->pairs[0].t_us + US_PER_S;
    for (size_t k = 0; k < data->count; k++) {
        push(self, &data->pairs[k]);
        step(self);
        if (data->pairs[k].t_us >= due_us) {
            get(self, &result);
            due_us += US_PER_S;
        }
    }
    get(self, &result);
    const double end_s = now_s();
    return (result.head.samples == data->count) ? end_s - begin_s : -1.0;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Each call by itself. `push_s` and `step_s` have room for all samples; the time of reading the clock is taken off. */
static void single_calls(subject_t *self, const data_t *data, double *push_s, double *step_s)
{
    double clock_s = 1.0;
    for (size_t k = 0; k < 1000; k++) {
        const double begin_s = now_s();
        const double end_s = now_s();
        clock_s = (end_s - begin_s < clock_s) ? end_s - begin_s : clock_s;
    }
    (void)start(self);
    for (size_t k = 0; k < data->count; k++) {
        const double begin_s = now_s();
        push(self, &data->pairs[k]);
        const double middle_s = now_s();
        step(self);
        const double end_s = now_s();
        push_s[k] = middle_s - begin_s - clock_s;
        step_s[k] = end_s - middle_s - clock_s;
    }
}

static double mean(const double *values, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; k++) {
        sum += values[k];
    }
    return sum / (double)count;
}

static bool measure(subject_t *self, const data_t *data, int repeats, double *room)
{
    double best_s = recording_s(self, data);
    double sum_s = best_s;
    for (int k = 1; k < repeats; k++) {
        const double s = recording_s(self, data);
        best_s = (s < best_s) ? s : best_s;
        sum_s += s;
    }
    if (best_s < 0.0) {
        (void)fputs("an engine refused its config or lost samples\n", stderr);
        return false;
    }
    double *const push_s = room;
    double *const step_s = room + data->count;
    single_calls(self, data, push_s, step_s);
    const double push_mean_s = mean(push_s, data->count);
    const double step_mean_s = mean(step_s, data->count);
    qsort(step_s, data->count, sizeof(double), compare);
    const size_t p99 = data->count * 99u / 100u;
    (void)printf("{\"engine\": \"%s\", \"n_max\": %u, \"state_bytes\": %zu, \"storage_bytes\": %zu, "
                 "\"push_ns\": %.1f, \"step_ns\": %.1f, \"step_p99_ns\": %.1f, \"recording_s\": %.6f, "
                 "\"recording_best_s\": %.6f, \"samples\": %zu}\n",
                 self->is_window ? "window" : "stream", self->is_window ? (unsigned)self->config.n_max : 0u,
                 self->is_window ? sizeof(jcal_hinge_window_t) : sizeof(jcal_hinge_t), self->storage_bytes,
                 1e9 * push_mean_s, 1e9 * step_mean_s, 1e9 * step_s[p99], sum_s / repeats, best_s, data->count);
    return true;
}

static bool read_file(const char *path, data_t *data)
{
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return false;
    }
    size_t room = 0;
    size_t got = 0;
    do {
        room = 2u * room + 4096u;
        void *const more = realloc(data->pairs, room * sizeof(jcal_pair_t));
        if (more == NULL) {
            (void)fclose(file);
            return false;
        }
        data->pairs = more;
        got = fread(data->pairs + data->count, sizeof(jcal_pair_t), room - data->count, file);
        data->count += got;
    } while (data->count == room);
    (void)fclose(file);
    return data->count > 0;
}

static bool measure_all(const data_t *data, int repeats)
{
    double *const room = malloc(2u * data->count * sizeof(double));
    if (room == NULL) {
        return false;
    }
    subject_t subject = {.is_window = false, .config = jcal_hinge_window_config_default()};
    bool done = measure(&subject, data, repeats, room);
    subject.is_window = true;
    for (size_t k = 0; k < N_MAX_COUNT && done; k++) {
        subject.config.n_max = N_MAX[k];
        subject.storage_bytes = jcal_hinge_window_storage_bytes(&subject.config);
        subject.storage = malloc(subject.storage_bytes);
        done = subject.storage != NULL && measure(&subject, data, 1, room);
        free(subject.storage);
    }
    free(room);
    return done;
}

int main(int argc, char **argv)
{
    const int repeats = (argc == 3) ? (int)strtol(argv[2], NULL, 10) : 1;
    if (argc < 2 || argc > 3 || repeats < 1) {
        (void)fputs("usage: jcal_bench FILE [REPEATS]\n", stderr);
        return EXIT_FAILURE;
    }
    data_t data = {0};
    const bool done = read_file(argv[1], &data) && measure_all(&data, repeats);
    free(data.pairs);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
