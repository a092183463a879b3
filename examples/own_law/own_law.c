/* PD on the sliding error, the built-in law `pd`: U = K_d s with K_d = 10. Run it with --set control.Lambda=5. */
#include <reed/law.h>

enum { kMostJoints = 8 };

typedef struct {
  double K_d[kMostJoints];
} State;

uint32_t reed_law_version(void) { return REED_LAW_VERSION; }

uint32_t reed_law_traits(void) { return 0; } /* neither force loop nor deflection */

size_t reed_law_state_size(const reed_law_setup* setup) {
  (void)setup;
  return sizeof(State);
}

const char* reed_law_start(const reed_law_setup* setup, void* state) {
  if (setup->joints > kMostJoints) return "this law controls up to 8 joints";
  for (int i = 0; i < setup->joints; ++i) ((State*)state)->K_d[i] = 10.0;
  return NULL;
}

void reed_law_step(const reed_law_input* in, void* state, reed_law_output* out) {
  const State* x = (const State*)state;
  for (int i = 0; i < in->joints; ++i) out->torque[i] = x->K_d[i] * in->s[i];
}
