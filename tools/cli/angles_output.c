/* SPDX-License-Identifier: MIT */
/* Rows of joint angles. */
#include "angles_output.h"

#include "json.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#define DEG_PER_RAD 57.2957795f

static exit_status_t failed(const angles_output_t *output)
{
    complain(output->name, 0, 0, "%s", strerror(errno));
    return EXIT_TROUBLE;
}

/* Zero, signs and convention; units become degrees. */
static jcal_joint_angles_t finish(const angles_output_t *output, const jcal_joint_angles_t *raw)
{
    jcal_joint_angles_t angles = *raw;
    if (output->zeroed) {
        const jcal_joint_angles_t *reference = &output->options->reference;
        angles.flexion_rad = jcal_angle_wrap((output->sign_flexion * (raw->flexion_rad - output->zero.flexion_rad)) +
                                             reference->flexion_rad);
        angles.pronation_rad = jcal_angle_wrap(
            (output->sign_pronation * (raw->pronation_rad - output->zero.pronation_rad)) + reference->pronation_rad);
        /* An axis turned round changes the sign of the scalar product of the axes; those of a hinge turn round together. */
        angles.carrying_rad = output->sign_flexion * output->sign_pronation * raw->carrying_rad;
    }
    angles = jcal_angles_signed(angles, output->options->positive);
    return (jcal_joint_angles_t){DEG_PER_RAD * angles.flexion_rad, DEG_PER_RAD * angles.pronation_rad,
                                 DEG_PER_RAD * angles.carrying_rad};
}

static void write_row(const angles_output_t *output, const angles_row_t *row)
{
    const char separator = output->options->sto ? '\t' : ',';
    char buffer[32];
    FILE *file = output->file;
    (void)fputs(row->has_time ? time_text(row->t_us, buffer) : "", file);
    if (!row->known) {
        (void)fputs(output->options->hinge ? ",\n" : ",,,,\n", file);
        return;
    }
    const jcal_joint_angles_t angles = finish(output, &row->angles);
    (void)fprintf(file, "%c%.4f", separator, (double)angles.flexion_rad);
    if (!output->options->hinge) {
        (void)fprintf(file, "%c%.4f%c%.4f%c%.4f", separator, (double)angles.pronation_rad, separator,
                      (double)angles.carrying_rad, separator, (double)(DEG_PER_RAD * row->heading_rad));
    }
    (void)fputc('\n', file);
}

static void write_header(const angles_output_t *output, uint64_t rows)
{
    FILE *file = output->file;
    const bool hinge = output->options->hinge;
    if (output->options->sto) {
        (void)fprintf(file, "jointcal angles\nversion=1\nnRows=%" PRIu64 "\nnColumns=%d\ninDegrees=yes\nendheader\n",
                      rows, hinge ? 2 : 5);
        (void)fputs(hinge ? "time\tflexion\n" : "time\tflexion\tpronation\tcarrying\theading_offset\n", file);
    } else {
        (void)fputs(hinge ? "t_s,flexion_deg\n" : "t_s,flexion_deg,pronation_deg,carrying_deg,heading_offset_deg\n",
                    file);
    }
}

/* True if nothing can be written before the last row is known. */
static bool must_wait(const angles_options_t *options)
{
    return options->sto || options->zero == ZERO_TIME || options->zero == ZERO_RANGE || options->signs_by_range;
}

exit_status_t angles_output_open(angles_output_t *output, const angles_options_t *options)
{
    memset(output, 0, sizeof *output);
    output->options = options;
    output->sign_flexion = 1.0f;
    output->sign_pronation = 1.0f;
    output->name = (options->out != NULL) ? options->out : "standard output";
    output->file = (options->out != NULL) ? fopen(options->out, "w") : stdout;
    if (output->file == NULL) {
        complain(output->name, 0, 0, "%s", strerror(errno));
        return EXIT_INPUT;
    }
    if (must_wait(options)) {
        output->waiting = tmpfile();
        if (output->waiting == NULL) {
            complain("temporary file", 0, 0, "%s", strerror(errno));
            return EXIT_TROUBLE;
        }
    } else {
        write_header(output, 0);
    }
    return EXIT_READY;
}

exit_status_t angles_output_row(angles_output_t *output, const angles_row_t *row)
{
    if (output->waiting != NULL) {
        if (fwrite(row, sizeof *row, 1, output->waiting) != 1) {
            complain("temporary file", 0, 0, "%s", strerror(errno));
            return EXIT_TROUBLE;
        }
        return EXIT_READY;
    }
    if (row->known && !output->zeroed && output->options->zero == ZERO_FIRST) {
        output->zero = row->angles;
        output->zeroed = true;
    }
    write_row(output, row);
    return (ferror(output->file) != 0) ? failed(output) : EXIT_READY;
}

/* The next row that waits; false at the end. */
static bool next_row(const angles_output_t *output, angles_row_t *row)
{
    return fread(row, sizeof *row, 1, output->waiting) == 1;
}

/* Finds the pose that --zero names. EXIT_INPUT if there is none although there are angles. */
static exit_status_t find_pose(angles_output_t *output)
{
    const angles_options_t *options = output->options;
    bool any = false;
    angles_row_t row;
    rewind(output->waiting);
    while (!output->zeroed && next_row(output, &row)) {
        any = any || row.known;
        if (row.known && (options->zero == ZERO_FIRST || (row.has_time && row.t_us >= options->zero_us))) {
            output->zero = row.angles;
            output->zeroed = true;
        }
    }
    if (any && !output->zeroed) {
        char buffer[32];
        complain("jointcal", 0, 0, "--zero: no row with angles at or after %s s", time_text(options->zero_us, buffer));
        return EXIT_INPUT;
    }
    return EXIT_READY;
}

/* Range of both angles, counted from the reference pose if there is one. */
static void find_range(const angles_output_t *output, jcal_angle_range_t *flexion, jcal_angle_range_t *pronation)
{
    jcal_angle_range_reset(flexion);
    jcal_angle_range_reset(pronation);
    /* Beginning with the pose itself, so that angles are followed from 0 on. */
    if (output->zeroed) {
        jcal_angle_range_push(flexion, 0.0f);
        jcal_angle_range_push(pronation, 0.0f);
    }
    angles_row_t row;
    rewind(output->waiting);
    while (next_row(output, &row)) {
        if (row.known) {
            jcal_angle_range_push(flexion, jcal_angle_wrap(row.angles.flexion_rad - output->zero.flexion_rad));
            jcal_angle_range_push(pronation, jcal_angle_wrap(row.angles.pronation_rad - output->zero.pronation_rad));
        }
    }
}

static float sign_of(const char *what, const jcal_angle_range_t *range)
{
    const int sign = jcal_axis_sign_by_range(range);
    if (sign == 0 && range->count > 1) {
        complain("jointcal", 0, 0, "warning: --signs range: mean %s is near zero, its sign stays as it is", what);
    }
    return (sign < 0) ? -1.0f : 1.0f;
}

static exit_status_t settle(angles_output_t *output)
{
    const angles_options_t *options = output->options;
    jcal_angle_range_t flexion;
    jcal_angle_range_t pronation;
    if (options->zero == ZERO_FIRST || options->zero == ZERO_TIME) {
        const exit_status_t status = find_pose(output);
        if (status != EXIT_READY) {
            return status;
        }
    }
    if (options->zero == ZERO_RANGE) {
        find_range(output, &flexion, &pronation);
        output->zero = (jcal_joint_angles_t){flexion.low_rad, pronation.low_rad, 0.0f};
        output->zeroed = flexion.count > 0;
    }
    if (options->signs_by_range) {
        find_range(output, &flexion, &pronation);
        output->sign_flexion = sign_of("flexion", &flexion);
        output->sign_pronation = options->hinge ? 1.0f : sign_of("pronation", &pronation);
    }
    return EXIT_READY;
}

/* A storage file has room for numbers only. */
static bool is_left_out(const angles_output_t *output, const angles_row_t *row)
{
    return output->options->sto && !(row->known && row->has_time);
}

static exit_status_t write_waiting(angles_output_t *output)
{
    const exit_status_t status = settle(output);
    if (status != EXIT_READY) {
        return status;
    }
    angles_row_t row;
    uint64_t rows = 0;
    rewind(output->waiting);
    while (next_row(output, &row)) {
        rows += is_left_out(output, &row) ? 0 : 1;
    }
    write_header(output, rows);
    rewind(output->waiting);
    while (next_row(output, &row)) {
        if (!is_left_out(output, &row)) {
            write_row(output, &row);
        }
    }
    if (ferror(output->waiting) != 0) {
        complain("temporary file", 0, 0, "%s", strerror(errno));
        return EXIT_TROUBLE;
    }
    return EXIT_READY;
}

exit_status_t angles_output_end(angles_output_t *output)
{
    const exit_status_t status = (output->waiting != NULL) ? write_waiting(output) : EXIT_READY;
    if (status != EXIT_READY) {
        return status;
    }
    return (fflush(output->file) != 0 || ferror(output->file) != 0) ? failed(output) : EXIT_READY;
}

void angles_output_close(angles_output_t *output)
{
    if (output->waiting != NULL) {
        (void)fclose(output->waiting);
    }
    if (output->file != NULL && output->file != stdout) {
        (void)fclose(output->file);
    }
}
