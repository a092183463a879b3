/* A control law from outside: four functions in a shared library, with a plain C interface.
 *
 *   gcc -shared -fPIC -O2 -o libmine.so mine.c        tools/reed run --law ./libmine.so
 *
 * The loop calls reed_law_step once per cycle. What it may not do there: allocate, lock, print, sleep, throw, or make
 * any other system call; `tools/reed budget --law ./libmine.so` proves that it does not. SI units. All arrays belong to
 * the caller and are valid during the call only. */
#ifndef REED_LAW_H
#define REED_LAW_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define REED_LAW_VERSION 1u
#define REED_LAW_MAX_VALUES 8

/* What reed_law_traits may answer, added up. */
#define REED_LAW_FORCE_LOOP 1u /* v and v_dot carry the force error along the wall's normal (30) */
#define REED_LAW_DEFLECTION 2u /* theta_d is corrected by the arm's static deflection (22) */

/* What the normal force is known from, reed_law_input.source. */
enum { REED_FORCE_NONE = 0, REED_FORCE_SENSOR = 1, REED_FORCE_UNKNOWN = 2, REED_FORCE_OBSERVER = 3 };

/* Before the loop starts. */
typedef struct reed_law_setup {
  int32_t joints;     /* n */
  int32_t parameters; /* m */
  double period_s;
  const double* K_d;    /* [n] N·m·s/rad, control.K_d */
  const double* Lambda; /* [n] 1/s, control.Lambda */
  const double* J_m;    /* [n] kg·m², rotor inertia reflected to the joint */
  const double* p_0;    /* [m] nominal parameters, units of the arm file */
  const char* argument; /* what follows the library's name in --law LIB.so:ARGUMENT, or "" */
} reed_law_setup;

/* One cycle. n joints, m parameters. */
typedef struct reed_law_input {
  int32_t joints;     /* n */
  int32_t parameters; /* m */
  double period_s;
  double time_s;  /* since the arm became active */
  int32_t adapt;  /* 0: estimates shall not move: the brakes hold the arm, or the cycle is short of time */
  int32_t source; /* REED_FORCE_… */
  const double* theta;        /* [n] rad, motor side */
  const double* theta_dot;    /* [n] rad/s */
  const double* theta_d;      /* [n] rad, reference (22) */
  const double* theta_d_dot;  /* [n] rad/s */
  const double* theta_d_ddot; /* [n] rad/s² */
  const double* v;            /* [n] rad/s, auxiliary velocity (24), (30) */
  const double* v_dot;        /* [n] rad/s² (25), (30) */
  const double* s;            /* [n] rad/s, v - theta_dot (23) */
  const double* Y; /* [m][n] regressor at (v, v_dot): column k, the n joints of parameter k, at Y + k * n */
  const double*
      f_known; /* [n] N·m, the part of the model without uncertain parameters: f = Y p + f_known (28) */
  const double* p_0;    /* [m] nominal parameters */
  const double* J_m;    /* [n] kg·m² */
  const double* Jt_F_d; /* [n] N·m, transposed Jacobian times desired force; 0 unless the arm presses */
  double f_n;           /* N, normal force: tared sensor or observer, see source */
  const double* r;      /* [n] N·m, observed disturbance where it may be subtracted, else 0 */
} reed_law_input;

typedef struct reed_law_output {
  double torque[8];                   /* [n] N·m, wanted at the joints; the limits have the last word */
  double values[REED_LAW_MAX_VALUES]; /* anything worth watching; those that have a name are recorded */
} reed_law_output;

/* To be implemented by the library. */
uint32_t reed_law_version(void);                   /* return REED_LAW_VERSION */
size_t reed_law_state_size(const reed_law_setup*); /* bytes; the loop owns them, zeroed */
const char* reed_law_start(const reed_law_setup*,
                           void* state); /* NULL, or one line: why this arm cannot be controlled */
void reed_law_step(const reed_law_input*, void* state, reed_law_output*); /* real time: see above */

/* Optional. */
uint32_t reed_law_traits(void); /* asked after start; absent: REED_LAW_FORCE_LOOP | REED_LAW_DEFLECTION */
const char* const* reed_law_value_names(void); /* at most REED_LAW_MAX_VALUES, then NULL; after start */
void reed_law_stop(void* state);               /* after the loop */

#ifdef __cplusplus
}
#endif
#endif
