# SPDX-License-Identifier: MIT
"""Mutations of formulas in lib/ and include/ for tools/mutate.py: (file, old text, new text, what it breaks).

The old text occurs exactly once in its file. SURVIVORS names those that no test can
tell from the original, with the reason.
"""

MODEL = "lib/calib/hinge_model.c"
EVIDENCE = "lib/calib/hinge_evidence.c"
BOUNDS = "lib/calib/hinge_bounds.c"
JUDGE = "lib/calib/hinge_judge.c"
SEARCH = "lib/calib/hinge_search.c"
POINT = "lib/calib/hinge_point.c"
ENGINE = "lib/calib/hinge.c"
RESIDUAL = "lib/calib/hinge_residual.h"
COST = "lib/calib/hinge_cost.c"
ACCEPT = "lib/calib/hinge_accept.c"
GATE = "lib/sample/gate.c"

MUTATIONS = [
    # The model: features, coefficients, derivatives.
    (MODEL, "out[3] = w.x * w.y;", "out[3] = w.x * w.z;", "product xy"),
    (MODEL, "products_out[1] = sign * (1.0f - (j.y * j.y));", "products_out[1] = sign * (1.0f + (j.y * j.y));",
     "sign in I - j j'"),
    (MODEL, "products_out[4] = sign * (-2.0f * j.x * j.z);", "products_out[4] = sign * (-1.0f * j.x * j.z);",
     "factor of a mixed product"),
    (MODEL, "store(axis->bias, -2.0f * sign, linear_out);", "store(axis->bias, 2.0f * sign, linear_out);",
     "sign of the bias in f"),
    (MODEL, "coefficients_of_sensor(&point->axis2, -1.0f,", "coefficients_of_sensor(&point->axis2, 1.0f,",
     "sign of sensor 2"),
    (MODEL, "point->axis1.bias) - jcal_vec3_dot(point->axis2.bias, point->axis2.bias);",
     "point->axis1.bias) + jcal_vec3_dot(point->axis2.bias, point->axis2.bias);", "sign of |b2|^2"),
    (MODEL, "column.run[2] = sign * (-2.0f * j.z * t.z);", "column.run[2] = sign * (-1.0f * j.z * t.z);",
     "factor in df/dj"),
    (MODEL, "column.run[5] = sign * (-2.0f * ((j.y * t.z) + (j.z * t.y)));",
     "column.run[5] = sign * (-2.0f * ((j.y * t.z) - (j.z * t.y)));", "symmetry of df/dj"),
    (MODEL, "store(j, 2.0f * sign * jcal_vec3_dot(t, axis->bias), &column.run[PRODUCTS]);",
     "store(j, -2.0f * sign * jcal_vec3_dot(t, axis->bias), &column.run[PRODUCTS]);", "the bias stays across j"),
    (MODEL, "store(t, -2.0f * sign * unit, &column.run[PRODUCTS]);",
     "store(t, -2.0f * sign, &column.run[PRODUCTS]);", "unit of the bias"),
    (MODEL, "column.one = 2.0f * sign * unit * jcal_vec3_dot(t, axis->bias);",
     "column.one = 1.0f * sign * unit * jcal_vec3_dot(t, axis->bias);", "factor of d|b|^2"),
    (MODEL, "return 1.0f / (2.0f * acc_bias_m_s2 * acc_bias_m_s2);", "return 1.0f / (acc_bias_m_s2 * acc_bias_m_s2);",
     "prior of the constant c"),
    (MODEL, "out[i] -= sums[i] * c;", "out[i] += sums[i] * c;", "sign of the elimination of c"),
    (MODEL, "out->gradient[r] += jcal_vec3_dot(axes[sensor]->bias, axes[sensor]->u) / unit;",
     "out->gradient[r] -= jcal_vec3_dot(axes[sensor]->bias, axes[sensor]->u) / unit;", "gradient of the bias prior"),
    (MODEL, "out->matrix[jcal_sym_at(r + 1u, r + 1u)] += 1.0f;", "out->matrix[jcal_sym_at(r + 1u, r)] += 1.0f;",
     "index of the bias prior"),
    (MODEL, "b[i] -= first;", "b[i] += first;", "difference of coefficients"),
    # Sums at the estimate.
    (EVIDENCE, "#define ACC_INFORMATION 4.0f", "#define ACC_INFORMATION 2.0f", "weight of the accelerometer"),
    (EVIDENCE, "(DIFFERENCE_SHARE * sqrtf(jcal_max(sample->w1_2, sample->w2_2))) + DIFFERENCE_NOISE_RAD_S;",
     "(DIFFERENCE_SHARE * sqrtf(jcal_max(sample->w1_2, sample->w2_2))) - DIFFERENCE_NOISE_RAD_S;",
     "errors in the difference of rates"),
    (EVIDENCE, "const float across_v = -2.0f * pull->gyr * jcal_vec3_dot(view->across, v);",
     "const float across_v = 2.0f * pull->gyr * jcal_vec3_dot(view->across, v);", "sign of a score"),
    (EVIDENCE, "scatter->fine[3] += pull->bias_unit * across_v;", "scatter->fine[3] += pull->bias_unit * across_u;",
     "index of a score"),
    (EVIDENCE, "scatter->fine[4] += pull->gyr * view->along * view->along;",
     "scatter->fine[4] += pull->gyr * view->along;", "second-order score"),
    (EVIDENCE, "const pull_t pull2 = {-gyr, -acc, gyr_bias_rad_s};",
     "const pull_t pull2 = {-gyr, acc, gyr_bias_rad_s};", "sign of (25) for sensor 2"),
    (EVIDENCE, "return cross + (view.along * view.across2);", "return cross - (view.along * view.across2);",
     "turn about the axis"),
    (EVIDENCE, "const float both = 2.0f * turn1 * turn2;", "const float both = turn1 * turn2;", "square of a difference"),
    (EVIDENCE, "self->turn_other += units * weight * (squares + both);",
     "self->turn_other += units * weight * (squares - both);", "cost of the other pairing"),
    (EVIDENCE, "self->across_rate2 += sample->dt_s * 0.5f * (view1->across2 + view2->across2);",
     "self->across_rate2 += sample->dt_s * (view1->across2 + view2->across2);", "mean of two sensors"),
    (EVIDENCE, "scatter->information2 += scatter->coarse_information * scatter->coarse_information;",
     "scatter->information2 += scatter->coarse_information;", "count of blocks"),
    (EVIDENCE, "#define BLOCK_SHARE 0.05f", "#define BLOCK_SHARE 0.1f", "length of coarse blocks"),
    (EVIDENCE, "    scatter->second *= 0.5f;", "    scatter->second *= 1.0f;", "halving"),
    # Bounds.
    (BOUNDS, "f[first + 4u] = 2.0f * j.x * j.z;", "f[first + 4u] = j.x * j.z;", "(w . j)^2"),
    (BOUNDS, "across[i] = all[i] - along[i];", "across[i] = all[i] + along[i];", "|w x j|^2"),
    (BOUNDS, "return NOISE_MARGIN * mean * (NOISE_FREE + (NOISE_SLOPE * ratio));",
     "return NOISE_MARGIN * mean * (NOISE_FREE - (NOISE_SLOPE * ratio));", "noise power"),
    (BOUNDS, "#define ACC_SYSTEMATIC 0.1f", "#define ACC_SYSTEMATIC 0.2f", "trust in (25)"),
    (BOUNDS, "sum -= lin->matrix[jcal_sym_at(AXIS + m, i)] * gain[k][m];",
     "sum += lin->matrix[jcal_sym_at(AXIS + m, i)] * gain[k][m];", "elimination of the biases"),
    (BOUNDS, "sum -= lin->matrix_acc[jcal_sym_at(i, k)] * doubt;", "sum += lin->matrix_acc[jcal_sym_at(i, k)] * doubt;",
     "discount of (25)"),
    (BOUNDS, "return 0.5f * ((d * g00) - (2.0f * b * g01) + (a * g11)) / determinant;",
     "return 0.5f * ((a * g00) - (2.0f * b * g01) + (d * g11)) / determinant;", "inverse of 2 x 2"),
    (BOUNDS, "rows[i][3] = -gain[r + i][r + 1u];", "rows[i][3] = -gain[r + i][r];", "index of a gain"),
    (BOUNDS, "const float closed = scatter->information - scatter->coarse_information;",
     "const float closed = scatter->information + scatter->coarse_information;", "closed blocks"),
    (BOUNDS, "(PRIOR_CORRELATION * fine * PRIOR_BLOCKS)", "(fine * PRIOR_BLOCKS)", "assumed correlation"),
    (BOUNDS, "b += variance * v[0] * v[1];", "b += variance * v[0] * v[0];", "covariance of an axis"),
    (BOUNDS, "(ONE_DIRECTION * (mean + half)) + (SECOND_DIRECTION", "(ONE_DIRECTION * (mean - half)) + (SECOND_DIRECTION",
     "larger eigenvalue"),
    (BOUNDS, "own->along4 - ((product * product) / jcal_max(other->along4, 1e-20f)) - pretended;",
     "own->along4 + ((product * product) / jcal_max(other->along4, 1e-20f)) - pretended;",
     "information about a squared tilt"),
    (BOUNDS, "doubts_t doubts = {{(4.0f * noise * power[0].along2)",
     "doubts_t doubts = {{(2.0f * noise * power[0].along2)", "pretended information"),
    (BOUNDS, "doubts.prior[0] = inflation[0];", "doubts.prior[0] = 1.0f;", "the prior beside larger residuals"),
    (BOUNDS, "block[jcal_sym_at(i, i)] -= (i < 2u) ? 0.0f : 1.0f;", "block[jcal_sym_at(i, i)] -= 0.0f;",
     "the prior scatters nothing"),
    (BOUNDS, "4.0f * mismatch * mismatch * (power[0].mixed + power[1].mixed)",
     "4.0f * mismatch * mismatch * (power[0].mixed - power[1].mixed)", "power of the mismatch"),
    (BOUNDS, "#define STEPS_LEFT 1.5f", "#define STEPS_LEFT 0.5f", "distance to the minimum"),
    (BOUNDS, "return first_holds ? jcal_min(first_order, second_order) : jcal_max(first_order, second_order);",
     "return first_holds ? jcal_min(first_order, second_order) : jcal_min(first_order, second_order);",
     "where the first order fails"),
    # Readiness.
    (JUDGE, "sign.evidence = 0.5f * (acc_odds + turn_odds);", "sign.evidence = 0.5f * (acc_odds - turn_odds);",
     "odds of the pairing"),
    (JUDGE, "#define EXCITATION_MIN 0.03f", "#define EXCITATION_MIN 0.0f", "a joint that does not move"),
    (JUDGE, "return error < ((MISFIT_SHARE * difference) + MISFIT_NOISE_RAD_S);",
     "return error > ((MISFIT_SHARE * difference) + MISFIT_NOISE_RAD_S);", "does it fit"),
    (JUDGE, "if (self->search.rounds == 0u) {", "if (self->search.rounds == 255u) {", "all starts tried"),
    (JUDGE, "return !(much_worse && (other > (RIVAL_RATIO_MIN * cost)));",
     "return (much_worse && (other > (RIVAL_RATIO_MIN * cost)));", "is a rival worse"),
    (JUDGE, "(bounds->bound1_rad > bounds->bound2_rad) ? JCAL_WEAK_AXIS1", "(bounds->bound1_rad < bounds->bound2_rad) ? JCAL_WEAK_AXIS1",
     "the weaker axis"),
    # Search.
    (SEARCH, "d[i] = scaled[i] * scales[i / 4u];", "d[i] = -scaled[i] * scales[i / 4u];", "direction of a step"),
    (SEARCH, "search->probe.j2 = jcal_vec3_scale(j2, ((start % 2u) == 0u) ? 1.0f : -1.0f);",
     "search->probe.j2 = jcal_vec3_scale(j2, 1.0f);", "starts of the other pairing"),
    (SEARCH, "jcal_vec3_dot(a->axis2.j, b->axis2.j)) > 0.0f;", "jcal_vec3_dot(a->axis2.j, b->axis2.j)) < 0.0f;",
     "same pairing"),
    (SEARCH, "const float packed[6] = {sums[0], sums[3], sums[1],", "const float packed[6] = {sums[0], sums[1], sums[3],",
     "layout of the rates' moments"),
    # Points, the engine.
    (POINT, "jcal_vec3_scale(point->axis2.j, -1.0f)", "jcal_vec3_scale(point->axis2.j, 1.0f)", "obeying the hint"),
    (POINT, "axis_move(&point->axis2, &d[2], &d[6], bias_unit);", "axis_move(&point->axis2, &d[2], &d[4], bias_unit);",
     "index of a bias step"),
    (ENGINE, "(noise * noise * (sample.w1_2 + sample.w2_2 + RATE_EPS));",
     "(noise * (sample.w1_2 + sample.w2_2 + RATE_EPS));", "weight of (24)"),
    (ENGINE, "(violation * violation);", "violation;", "weight of (25)"),
    (ENGINE, "const float violation = self->cfg.lever_arm_m * self->rate_product;",
     "const float violation = 0.0f * self->rate_product;", "lever arm"),
    (ENGINE, "jcal_sym_scale(self->moments.acc, 7u, 0.5f);", "jcal_sym_scale(self->moments.acc, 7u, 1.0f);", "halving"),
    # Window engine.
    (RESIDUAL, "derivative[1] = scale * q;", "derivative[1] = -scale * q;", "Jacobian of (24)"),
    (RESIDUAL, "return across1 - across2;", "return across1 + across2;", "(24)"),
    (ACCEPT, "/ (n - 1.0f);", "/ n;", "(58)"),
    (ACCEPT, "const float turned2 = JCAL_PI - same2;", "const float turned2 = same2;", "(66)"),
    # Gate and mathematics.
    (GATE, "(magnitude >= sensor->extreme[i])", "(magnitude > sensor->extreme[i])", "clipping"),
    (GATE, "jcal_vec3_cross(imu->acc_m_s2, imu->gyr_rad_s)", "jcal_vec3_cross(imu->acc_m_s2, imu->acc_m_s2)",
     "turning gravity"),
    (GATE, "return (dt_s > cfg->gap_s) ? JCAL_REJECT_GAP", "return (dt_s < cfg->gap_s) ? JCAL_REJECT_GAP", "gap"),
    ("lib/math/scalar.h", "(s2 * (2.0f / 7.0f))", "(s2 * (2.0f / 9.0f))", "series of the logarithm"),
    ("lib/math/sym.h", "return diagonal + (2.0f * below);", "return diagonal + below;", "quadratic form"),
    ("lib/math/sphere.h", "const float b = j.x * j.y * a;", "const float b = j.x * j.z * a;", "tangent basis"),
    ("include/jointcal/vec3.h", "a.z * b.x - a.x * b.z", "a.x * b.z - a.z * b.x", "vector product"),
]

# Old text -> why no test can see the difference.
SURVIVORS: dict[str, str] = {}
