/*
 * bliman_sorine: the second-order friction model of Bliman and Sorine, as a law from outside the tree.
 *
 * Friction depends on the path s of the mass since it last turned, not on its speed: fast bristles of a high level
 * build up the force, slow ones of a low level take a part of it back, so that the force passes a peak, as at
 * break-away, before it settles at the kinetic level. With L the kinetic level and r the share of the slow bristles
 *
 *   F = z_fast - z_slow
 *   z_fast' = (v (1 + r) L - |v| z_fast)/fast_distance
 *   z_slow' = (v r L - |v| z_slow)/slow_distance
 *
 * It is the published model with f1 = (1 + r) L, f2 = r L, epsilon_f = slow_distance, eta = fast_distance/slow_distance.
 * Passive: over s it is the linear filter f1/(1 + a p) - f2/(1 + b p) of sgn v, a < b, whose real part
 * f1/(1 + a^2 w^2) - f2/(1 + b^2 w^2) is positive at every w.
 *
 * Source: Bliman, P.-A. and Sorine, M., Easy-to-use realistic dry friction models for automatic control, Proceedings
 * of the 3rd European Control Conference, Rome, 1995, pp. 3788-3794.
 */
#include <dualdamp_law.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct bliman_sorine {
  double kinetic;       /* N */
  double slow_share;    /* 1 */
  double fast_distance; /* m */
  double slow_distance; /* m */
};

static const struct dualdamp_parameter parameters[] = {
    {.name = "kinetic",
     .unit = "N",
     .meaning = "friction force of a long slip",
     .low_is_open = 1,
     .high = INFINITY,
     .is_limit = 1},
    {.name = "slow_share",
     .unit = "1",
     .meaning = "level of the slow bristles over the kinetic one; 0 gives dahl",
     .high = INFINITY},
    {.name = "fast_distance",
     .unit = "m",
     .meaning = "path over which the fast bristles follow a reversal",
     .low_is_open = 1,
     .high = INFINITY},
    {.name = "slow_distance",
     .unit = "m",
     .meaning = "path over which the slow bristles follow; above fast_distance",
     .low_is_open = 1,
     .high = INFINITY},
};

static int create(const double* values, void** law, char* message, unsigned message_size) {
  const struct bliman_sorine given = {values[0], values[1], values[2], values[3]};
  struct bliman_sorine* made = NULL;
  if (given.slow_distance <= given.fast_distance) {
    snprintf(message, message_size, "slow_distance must be above fast_distance, %g m", given.fast_distance);
    return 1;
  }
  if (given.slow_share == 0.0) {
    snprintf(message, message_size, "without slow bristles there is no peak: this is dahl with sigma0 = %g N/m",
             given.kinetic / given.fast_distance);
  }
  made = malloc(sizeof *made);
  if (made == NULL) return 2;
  *made = given;
  *law = made;
  return DUALDAMP_OK;
}

static void destroy(void* law) { free(law); }

enum { fast, slow, state_count };

/* The frozen direction stands for sgn v: |v| = direction v. */
static int respond(const void* law, int mode, const double* states, const struct dualdamp_instant* now, double* force,
                   double* rates) {
  const struct bliman_sorine* p = law;
  const double level = dualdamp_limit(now, p->kinetic);
  const double speed = now->direction * now->v;
  (void)mode;
  rates[fast] = (now->v * (1.0 + p->slow_share) * level - speed * states[fast]) / p->fast_distance;
  rates[slow] = (now->v * p->slow_share * level - speed * states[slow]) / p->slow_distance;
  *force = states[fast] - states[slow];
  return DUALDAMP_OK;
}

static int scales(const void* law, double* scales) {
  const struct bliman_sorine* p = law;
  scales[fast] = scales[slow] = (1.0 + p->slow_share) * p->kinetic;
  return DUALDAMP_OK;
}

const struct dualdamp_law_table* dualdamp_law(void) {
  static const struct dualdamp_law_table table = {
      .size = sizeof table,
      .abi = DUALDAMP_LAW_ABI,
      .abilities = DUALDAMP_IS_ODD | DUALDAMP_IS_PASSIVE,
      .modes = 1,
      .states = state_count,
      .parameter_count = sizeof parameters / sizeof *parameters,
      .parameters = parameters,
      .name = "bliman_sorine",
      .version = "1.0",
      .summary = "fast bristles less slow ones, which gives a peak at break-away (Bliman and Sorine)",
      .equation = "F = z_fast - z_slow;  z_fast' = (v (1 + slow_share) kinetic - |v| z_fast)/fast_distance;  "
                  "z_slow' = (v slow_share kinetic - |v| z_slow)/slow_distance",
      .remembers = "force of the fast and of the slow bristles",
      .sources = "Bliman and Sorine, European Control Conference, Rome, 1995",
      .create = create,
      .destroy = destroy,
      .respond = respond,
      .scales = scales,
  };
  return &table;
}
