/* SPDX-License-Identifier: MIT */
/* Rows of joint angles. */
#include "output/angle_table.h"

#include "output/json.h"
#include "output/part_file.h"
#include "units.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Axes that may be off by more than this are still being sought: what jumps with them is no turn. */
#define FOLLOW_BOUND_RAD 0.2f

static exit_status_t failed(const angle_table_t *table)
{
    return complain_output(table->name);
}

/* Zero, signs and convention; units become degrees. */
static jcal_joint_angles_t finish(const angle_table_t *table, const jcal_joint_angles_t *raw)
{
    jcal_joint_angles_t angles = *raw;
    if (table->zeroed) {
        const jcal_joint_angles_t *reference = &table->config->reference;
        angles.flexion_rad = jcal_angle_wrap((table->sign_flexion * (raw->flexion_rad - table->zero.flexion_rad)) +
                                             reference->flexion_rad);
        angles.pronation_rad = jcal_angle_wrap(
            (table->sign_pronation * (raw->pronation_rad - table->zero.pronation_rad)) + reference->pronation_rad);
        /* An axis turned round changes the sign of the scalar product of the axes; those of a hinge turn round together. */
        angles.carrying_rad = table->sign_flexion * table->sign_pronation * raw->carrying_rad;
    }
    angles = jcal_angles_signed(angles, table->config->positive);
    return (jcal_joint_angles_t){DEG_PER_RAD * angles.flexion_rad, DEG_PER_RAD * angles.pronation_rad,
                                 DEG_PER_RAD * angles.carrying_rad};
}

/* The turn of an angle that is nearest to the one before: a series has no jumps of a full turn. */
static float follow(float angle_deg, float before_deg)
{
    return angle_deg + (360.0f * roundf((before_deg - angle_deg) / 360.0f));
}

/* True of the columns that this table has. */
static bool has_column(const angle_table_config_t *config, int column)
{
    if (column == ANGLE_BOUND) {
        return config->has_bound;
    }
    return column == ANGLE_FLEXION || !config->hinge;
}

static void write_row(angle_table_t *table, const angles_row_t *row)
{
    const angle_table_config_t *config = table->config;
    char buffer[32];
    FILE *file = table->file;
    (void)fputs(row->has_time ? time_text(row->t_us, buffer) : "", file);
    jcal_joint_angles_t angles = {0.0f, 0.0f, 0.0f};
    if (row->known) {
        angles = finish(table, &row->angles);
        if (table->has_last) {
            angles.flexion_rad = follow(angles.flexion_rad, table->last_deg.flexion_rad);
            angles.pronation_rad = follow(angles.pronation_rad, table->last_deg.pronation_rad);
            angles.carrying_rad =
                config->shoulder ? follow(angles.carrying_rad, table->last_deg.carrying_rad) : angles.carrying_rad;
        }
        table->last_deg = angles;
        table->has_last = row->bound_rad < FOLLOW_BOUND_RAD;
    }
    const float values[ANGLE_TABLE_COLUMNS] = {angles.flexion_rad, angles.pronation_rad, angles.carrying_rad,
                                               DEG_PER_RAD * row->heading_rad, DEG_PER_RAD * row->bound_rad};
    for (int k = 0; k < ANGLE_TABLE_COLUMNS; k++) {
        if (has_column(config, k)) {
            (void)fputc(config->sto ? '\t' : ',', file);
            if (row->known) {
                (void)fprintf(file, "%.4f", (double)values[k]);
            }
        }
    }
    (void)fputc('\n', file);
}

/* Names of the columns of CSV; those of a storage file are without the unit. */
static const char *name_of(const angle_table_config_t *config, int column)
{
    static const char *const usual[ANGLE_TABLE_COLUMNS] = {"flexion", "pronation", "carrying", "heading_offset",
                                                           "bound"};
    static const char *const hip[] = {"flexion", "rotation", "adduction"};
    static const char *const shoulder[] = {"elevation", "axial_rotation", "plane_of_elevation"};
    if (!config->ball || column > ANGLE_CARRYING) {
        return usual[column];
    }
    return config->shoulder ? shoulder[column] : hip[column];
}

static void write_header(const angle_table_t *table, uint64_t rows)
{
    const angle_table_config_t *config = table->config;
    FILE *file = table->file;
    int columns = 1;
    for (int k = 0; k < ANGLE_TABLE_COLUMNS; k++) {
        columns += has_column(config, k) ? 1 : 0;
    }
    if (config->sto) {
        (void)fprintf(file, "jointcal angles\nversion=1\nnRows=%" PRIu64 "\nnColumns=%d\ninDegrees=yes\nendheader\n",
                      rows, columns);
    }
    (void)fputs(config->sto ? "time" : "t_s", file);
    for (int k = 0; k < ANGLE_TABLE_COLUMNS; k++) {
        if (has_column(config, k)) {
            const char *given = config->sto ? config->names[k] : NULL;
            (void)fprintf(file, "%c%s%s", config->sto ? '\t' : ',', (given != NULL) ? given : name_of(config, k),
                          config->sto ? "" : "_deg");
        }
    }
    (void)fputc('\n', file);
}

/* True if nothing can be written before the last row is known. */
static bool must_wait(const angle_table_config_t *config)
{
    return config->sto || config->zero == ZERO_TIME || config->zero == ZERO_RANGE || config->signs_by_range;
}

exit_status_t angle_table_open(angle_table_t *table, const angle_table_config_t *config)
{
    memset(table, 0, sizeof *table);
    table->config = config;
    table->sign_flexion = 1.0f;
    table->sign_pronation = 1.0f;
    table->name = (config->out != NULL) ? config->out : "standard output";
    table->file = (config->out != NULL) ? part_file_open(config->out) : stdout;
    if (table->file == NULL) {
        complain(table->name, 0, 0, "%s", strerror(errno));
        return EXIT_INPUT;
    }
    if (must_wait(config)) {
        table->waiting = tmpfile();
        if (table->waiting == NULL) {
            complain("temporary file", 0, 0, "%s", strerror(errno));
            return EXIT_TROUBLE;
        }
    } else {
        write_header(table, 0);
    }
    return EXIT_READY;
}

exit_status_t angle_table_row(angle_table_t *table, const angles_row_t *row)
{
    if (table->waiting != NULL) {
        if (fwrite(row, sizeof *row, 1, table->waiting) != 1) {
            complain("temporary file", 0, 0, "%s", strerror(errno));
            return EXIT_TROUBLE;
        }
        return EXIT_READY;
    }
    if (row->known && !table->zeroed && table->config->zero == ZERO_FIRST) {
        table->zero = row->angles;
        table->zeroed = true;
    }
    write_row(table, row);
    return (ferror(table->file) != 0) ? failed(table) : EXIT_READY;
}

/* The next row that waits; false at the end. */
static bool next_row(const angle_table_t *table, angles_row_t *row)
{
    return fread(row, sizeof *row, 1, table->waiting) == 1;
}

/* Finds the pose that --zero names. EXIT_INPUT if there is none although there are angles. */
static exit_status_t find_pose(angle_table_t *table)
{
    const angle_table_config_t *config = table->config;
    bool any = false;
    angles_row_t row;
    rewind(table->waiting);
    while (!table->zeroed && next_row(table, &row)) {
        any = any || row.known;
        if (row.known && (config->zero == ZERO_FIRST || (row.has_time && row.t_us >= config->zero_us))) {
            table->zero = row.angles;
            table->zeroed = true;
        }
    }
    if (any && !table->zeroed) {
        char buffer[32];
        complain("jointcal", 0, 0, "--zero: no row with angles at or after %s s", time_text(config->zero_us, buffer));
        return EXIT_INPUT;
    }
    return EXIT_READY;
}

/* Range of both angles, counted from the reference pose if there is one. */
static void find_range(const angle_table_t *table, jcal_angle_range_t *flexion, jcal_angle_range_t *pronation)
{
    jcal_angle_range_reset(flexion);
    jcal_angle_range_reset(pronation);
    /* Beginning with the pose itself, so that angles are followed from 0 on. */
    if (table->zeroed) {
        jcal_angle_range_push(flexion, 0.0f);
        jcal_angle_range_push(pronation, 0.0f);
    }
    angles_row_t row;
    rewind(table->waiting);
    while (next_row(table, &row)) {
        if (row.known) {
            jcal_angle_range_push(flexion, jcal_angle_wrap(row.angles.flexion_rad - table->zero.flexion_rad));
            jcal_angle_range_push(pronation, jcal_angle_wrap(row.angles.pronation_rad - table->zero.pronation_rad));
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

static exit_status_t settle(angle_table_t *table)
{
    const angle_table_config_t *config = table->config;
    jcal_angle_range_t flexion;
    jcal_angle_range_t pronation;
    if (config->zero == ZERO_FIRST || config->zero == ZERO_TIME) {
        const exit_status_t status = find_pose(table);
        if (status != EXIT_READY) {
            return status;
        }
    }
    if (config->zero == ZERO_RANGE) {
        find_range(table, &flexion, &pronation);
        table->zero = (jcal_joint_angles_t){flexion.low_rad, pronation.low_rad, 0.0f};
        table->zeroed = flexion.count > 0;
    }
    if (config->signs_by_range) {
        find_range(table, &flexion, &pronation);
        table->sign_flexion = sign_of("flexion", &flexion);
        table->sign_pronation = config->hinge ? 1.0f : sign_of("pronation", &pronation);
    }
    return EXIT_READY;
}

/* A storage file has room for numbers only. */
static bool is_left_out(const angle_table_t *table, const angles_row_t *row)
{
    return table->config->sto && !(row->known && row->has_time);
}

static exit_status_t write_waiting(angle_table_t *table)
{
    const exit_status_t status = settle(table);
    if (status != EXIT_READY) {
        return status;
    }
    angles_row_t row;
    uint64_t rows = 0;
    rewind(table->waiting);
    while (next_row(table, &row)) {
        rows += is_left_out(table, &row) ? 0 : 1;
    }
    write_header(table, rows);
    rewind(table->waiting);
    while (next_row(table, &row)) {
        if (!is_left_out(table, &row)) {
            write_row(table, &row);
        }
    }
    if (ferror(table->waiting) != 0) {
        complain("temporary file", 0, 0, "%s", strerror(errno));
        return EXIT_TROUBLE;
    }
    return EXIT_READY;
}

exit_status_t angle_table_end(angle_table_t *table)
{
    const exit_status_t status = (table->waiting != NULL) ? write_waiting(table) : EXIT_READY;
    if (status != EXIT_READY) {
        return status;
    }
    if (fflush(table->file) != 0 || ferror(table->file) != 0) {
        return failed(table);
    }
    FILE *file = table->file;
    if (file != stdout) {
        table->file = NULL;
        return part_file_finish(file, table->name) ? EXIT_READY : failed(table);
    }
    return EXIT_READY;
}

void angle_table_close(angle_table_t *table)
{
    if (table->waiting != NULL) {
        (void)fclose(table->waiting);
    }
    if (table->file != NULL && table->file != stdout) {
        part_file_drop(table->file);
    }
}
