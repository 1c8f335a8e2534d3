#pragma once
/*
 * A friction law from outside the tree: the C interface between dualdamp and a shared library.
 *
 * The library exports one function, dualdamp_law(), which returns a table. Only plain C crosses: no C++ type and no
 * exception. docs/plugins.md writes a law in thirty minutes; docs/plugins/bliman_sorine/ is a complete one.
 *
 * A law. The mass has position x [m] and velocity v [m/s]; the law gives the force F [N], F > 0 opposing v > 0. It
 * may remember a mode (0 to modes - 1) and continuous states. The program computes the motion of the mass, what
 * happens at v = 0 and, for a law with a static limit, sticking. x and v are continuous across a mode change.
 *
 * Pure functions. The memory of a law is the mode and the states that its functions are given; the same arguments
 * give the same results. Several threads call one law at the same time, so it holds only its parameters and nothing
 * that changes.
 *
 * Frozen direction. Between events the direction of slip does not change: write direction * v where the formula has
 * |v|, and direction where it has sgn v. The program may evaluate the formula a little beyond v = 0, where direction
 * and the sign of v differ, and a little beyond a guard; the formula must stay smooth there.
 *
 * Force limits. A law gets each of its force limits from dualdamp_limit(). Modifiers (drift, fluctuation, ...) act
 * there; the law needs no code for them.
 *
 * Versions. The program refuses a table of another DUALDAMP_LAW_ABI. New members are added only at the end, with a
 * new version.
 */

#ifdef __cplusplus
extern "C" {
#endif

#define DUALDAMP_LAW_ABI 1u

#if defined(_WIN32)
#define DUALDAMP_LAW_EXPORT __declspec(dllexport)
#else
#define DUALDAMP_LAW_EXPORT __attribute__((visibility("default")))
#endif

/* What functions return: 0, or a number of the law's choice, which ends the run with a message. */
enum { DUALDAMP_OK = 0 };

/* Facts about a law, or-ed into `abilities`. The conformance suite tests them. */
enum {
  DUALDAMP_IS_ODD = 1,    /* the mirrored motion gives the mirrored force */
  DUALDAMP_IS_PASSIVE = 2 /* it never gives out more work than it took in */
};

/* Why jump() is called: the index of the guard that reached zero, or one of these. */
enum {
  DUALDAMP_DIRECTION_CHANGE = -1, /* the mass stops, reverses or is released */
  DUALDAMP_LIMIT_CHANGE = -2      /* a modifier is about to change the force limits by a step */
};

/* A parameter as users write it. Numbers arrive in SI units, in the order of the table, within the range. */
struct dualdamp_parameter {
  const char* name;    /* key in the scenario file: small letters, digits, '_' */
  const char* unit;    /* SI, in udunits2 spelling: "N", "N/m", "N.s/m", "m/s", "1" */
  const char* meaning; /* one line */
  double low;          /* smallest value; -INFINITY: none */
  double high;         /* largest value; INFINITY: none */
  int low_is_open;     /* nonzero: `low` itself is refused */
  int high_is_open;
  int has_default; /* zero: required */
  double fallback; /* the default */
  /* Nonzero: a force limit, or what multiplies the whole force. A law with such a parameter takes the modifiers
   * drift and fluctuation, which multiply it; and position_slope, which adds to it, when each of them is in "N". */
  int is_limit;
};

/* The mass at one instant. */
struct dualdamp_instant {
  double t;      /* s */
  double x;      /* m */
  double v;      /* m/s */
  int direction; /* of slip: -1 or 1; 0: the mass sticks */
  double limit_factor;
  double limit_offset;   /* N */
  double limit_vanished; /* N: limits up to this are zero */
};

/* A force limit of `nominal` at this instant, modifiers included; in the unit of `nominal`. */
static inline double dualdamp_limit(const struct dualdamp_instant* now, double nominal) {
  return nominal <= now->limit_vanished ? 0.0 : now->limit_factor * nominal + now->limit_offset;
}

/* Texts are printable ASCII, one line each, at most 1000 characters; NULL where there is nothing to say. */
struct dualdamp_law_table {
  unsigned size;            /* sizeof(struct dualdamp_law_table) */
  unsigned abi;             /* DUALDAMP_LAW_ABI */
  unsigned abilities;       /* DUALDAMP_IS_... */
  unsigned modes;           /* number of modes, at least 1 */
  unsigned states;          /* number of continuous states, at most 64, the same in every mode */
  unsigned guards;          /* number of guards, at most 16, the same in every mode */
  unsigned parameter_count; /* at most 64 */
  const struct dualdamp_parameter* parameters;

  const char* name;      /* as in friction: {law: name}; required */
  const char* version;   /* of the law, for the provenance of results; required */
  const char* summary;   /* one line; required */
  const char* equation;  /* required */
  const char* remembers; /* what its states and modes are */
  const char* caution;   /* what the literature warns of, one sentence */
  const char* sources;   /* literature */

  /* Required. Makes a law with these values, in *law; NULL is a law too. It may refuse values, each of which is in
   * range, with a status other than 0: `message` then says why. With status 0 `message` may warn of the values. `message`
   * has room for `message_size` characters and begins empty. */
  int (*create)(const double* values, void** law, char* message, unsigned message_size);
  /* Required. */
  void (*destroy)(void* law);

  /* Required. The force [N] and the rate of each state [its unit per s], with mode and direction frozen. */
  int (*respond)(const void* law, int mode, const double* states, const struct dualdamp_instant* now, double* force,
                 double* rates);
  /* Required with states. The size of each state in a motion that slips, > 0: errors are measured against it. */
  int (*scales)(const void* law, double* scales);

  /* Optional. Mode and states at the start; without this function mode 0 and states 0. */
  int (*start)(const void* law, const struct dualdamp_instant* now, int* mode, double* states);
  /* Optional. The static limit [N], >= 0: how far the force of a mass that sticks can differ from the law's force
   * for direction 0. That force is 0 for a law that holds the mass equally in both directions. */
  int (*static_limit)(const void* law, int mode, const double* states, const struct dualdamp_instant* now,
                      double* limit);
  /* Required with guards. Values > 0 while the mode holds; it ends when one reaches 0 from above. A guard that has
   * no meaning in a mode is 1 there. */
  int (*guard)(const void* law, int mode, const double* states, const struct dualdamp_instant* now, double* values);
  /* Required with guards or more than one mode. The mode change at a guard or when the direction changes;
   * now->direction is the new one. It decides by mode, cause and direction, not by values, and is called again
   * while a guard is below 0 in the new mode. */
  int (*jump)(const void* law, int cause, const struct dualdamp_instant* now, int* mode, double* states);
  /* Optional. The power turned to heat [W], for a law that stores energy; without this function F v. */
  int (*dissipation)(const void* law, int mode, const double* states, const struct dualdamp_instant* now,
                     double* power);
};

/* The one symbol that a library exports. The table and its texts live as long as the library. */
DUALDAMP_LAW_EXPORT const struct dualdamp_law_table* dualdamp_law(void);

#ifdef __cplusplus
}
#endif
