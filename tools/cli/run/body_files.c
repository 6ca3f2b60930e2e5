/* SPDX-License-Identifier: MIT */
/* The recording of a whole body. */
#include "run/body_files.h"

#include "run/reading.h"
#include "run/sensor_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static exit_status_t no_memory(void)
{
    complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    return EXIT_TROUBLE;
}

static bool add(radio_t *radio, int64_t t_us, const jcal_imu_t *imu)
{
    const radio_row_t row = {.t_us = t_us,
                             .values = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z, imu->acc_m_s2.x,
                                        imu->acc_m_s2.y, imu->acc_m_s2.z}};
    return radio_add(radio, &row);
}

/* ---- One file of all sensors ---- */

static exit_status_t read_rows(body_files_t *self, reading_t *reading)
{
    recording_row_t row;
    recording_event_t event = recording_next(&reading->recording, &row);
    for (; event == RECORDING_ROW; event = recording_next(&reading->recording, &row)) {
        const jcal_imu_t *const imus[] = {&row.imu1, &row.imu2, &row.imu3};
        for (unsigned k = 0; k < self->count && k < sizeof imus / sizeof imus[0] && row.has_time; k++) {
            if (!add(&self->radios[k], row.t_us, imus[k])) {
                return no_memory();
            }
        }
    }
    return (event == RECORDING_END) ? EXIT_READY : reading_give_up(reading, event);
}

static exit_status_t read_one_file(body_files_t *self, const char *name, bool sorted)
{
    reading_t reading;
    exit_status_t status = reading_open(&reading, name, sorted);
    if (status == EXIT_READY) {
        self->count = recording_has_third(&reading.recording) ? 3u : 2u;
        const recording_event_t event = (self->count == 3u) ? recording_want_third(&reading.recording) : RECORDING_ROW;
        status = (event == RECORDING_ROW) ? read_rows(self, &reading) : reading_give_up(&reading, event);
    }
    reading_close(&reading);
    return status;
}

/* ---- A file for each sensor ---- */

static exit_status_t give_up(const sensor_file_t *file, const char *name, recording_event_t event)
{
    const recording_fault_t *fault = &file->recording.fault;
    if (event == RECORDING_BAD) {
        complain(name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(name, 0, 0, "%s", strerror((file->input.error != 0) ? file->input.error : ENOMEM));
    return (file->input.descriptor < 0) ? EXIT_INPUT : EXIT_TROUBLE;
}

static exit_status_t read_sensor(radio_t *radio, const char *name, bool sorted)
{
    sensor_file_t file;
    recording_row_t row = {0};
    exit_status_t status = EXIT_READY;
    recording_event_t event = sensor_file_open(&file, name, 1, sorted);
    for (event = (event == RECORDING_ROW) ? sensor_file_next(&file, &row) : event;
         event == RECORDING_ROW && status == EXIT_READY; event = sensor_file_next(&file, &row)) {
        status = add(radio, row.t_us, &row.imu1) ? EXIT_READY : no_memory();
    }
    if (status == EXIT_READY && event != RECORDING_END) {
        status = give_up(&file, name, event);
    }
    sensor_file_close(&file);
    return status;
}

static int64_t first_us(const radio_t *radio)
{
    return radio->rows[0].t_us;
}

static int64_t last_us(const radio_t *radio)
{
    return radio->rows[radio->row_count - 1].t_us;
}

/* As for two files: one clock that is a little off if times overlap for half of the shorter one, else one beginning. */
static bool is_one_clock(const radio_t *one, const radio_t *other)
{
    const int64_t begin = (first_us(one) > first_us(other)) ? first_us(one) : first_us(other);
    const int64_t end = (last_us(one) < last_us(other)) ? last_us(one) : last_us(other);
    const int64_t length_one = last_us(one) - first_us(one);
    const int64_t length_other = last_us(other) - first_us(other);
    const int64_t shorter = (length_one < length_other) ? length_one : length_other;
    return end > begin && 2 * (end - begin) >= shorter;
}

static void shift_times(body_files_t *self)
{
    for (unsigned k = 1; k < self->count; k++) {
        radio_t *radio = &self->radios[k];
        if (is_one_clock(&self->radios[0], radio)) {
            continue;
        }
        self->shift_us[k] = first_us(radio) - first_us(&self->radios[0]);
        for (size_t row = 0; row < radio->row_count; row++) {
            radio->rows[row].t_us -= self->shift_us[k];
        }
    }
}

/* ---- Both ---- */

/* A sensor of which nothing can be made. */
static exit_status_t check_rows(const body_files_t *self, const char *const *names, unsigned files)
{
    for (unsigned k = 0; k < self->count; k++) {
        const double period_us = radio_period_us(&self->radios[k]);
        if (!(period_us >= 500.0 && period_us <= 1e6)) {
            complain(names[(files > 1) ? k : 0], 0, 0, "%s",
                     (period_us > 0.0) ? "a sensor must have from 1 to 2000 rows a second"
                                       : "a sensor needs at least two rows whose times increase");
            return EXIT_INPUT;
        }
    }
    return EXIT_READY;
}

exit_status_t body_files_read(body_files_t *self, const char *const *names, unsigned count, bool sorted)
{
    memset(self, 0, sizeof *self);
    self->count = count;
    exit_status_t status = EXIT_READY;
    if (count == 1) {
        status = read_one_file(self, names[0], sorted);
    }
    for (unsigned k = 0; count > 1 && k < count && status == EXIT_READY; k++) {
        status = read_sensor(&self->radios[k], names[k], sorted);
    }
    status = (status == EXIT_READY) ? check_rows(self, names, count) : status;
    if (status == EXIT_READY) {
        shift_times(self);
        self->start_us = first_us(&self->radios[0]);
        for (unsigned k = 0; k < self->count; k++) {
            const int64_t end_us = last_us(&self->radios[k]);
            self->end_us = (k == 0 || end_us > self->end_us) ? end_us : self->end_us;
        }
    }
    return status;
}

const radio_packet_t *body_files_next(body_files_t *self, unsigned *sensor)
{
    const radio_packet_t *next = NULL;
    for (unsigned k = 0; k < self->count; k++) {
        const radio_t *radio = &self->radios[k];
        if (self->at[k] < radio->packet_count &&
            (next == NULL || radio->packets[self->at[k]].arrival_us < next->arrival_us)) {
            next = &radio->packets[self->at[k]];
            *sensor = k;
        }
    }
    if (next != NULL) {
        self->at[*sensor]++;
    }
    return next;
}

void body_files_free(body_files_t *self)
{
    for (unsigned k = 0; k < BODY_FILES_MAX; k++) {
        radio_free(&self->radios[k]);
    }
}
