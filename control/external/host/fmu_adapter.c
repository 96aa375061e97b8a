#include "fmu_adapter.h"

#include <dlfcn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "ambrig_controller.h"

#define MOST_SIGNALS 512
#define MOST_TEXT 4096

/* One number that goes in or out. */
typedef struct signal_of_fmu {
  char field[16];
  unsigned index, reference;
} signal_of_fmu;

typedef struct parameter_of_fmu {
  char type;
  unsigned reference;
  double value;
} parameter_of_fmu;

typedef struct fmi2_callbacks {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} fmi2_callbacks;

typedef int (*plain)(void *);
typedef int (*set_real2)(void *, const unsigned *, size_t, const double *);
typedef int (*set_int2)(void *, const unsigned *, size_t, const int *);
typedef int (*set_real3)(void *, const unsigned *, size_t, const double *, size_t);

static struct {
  int fmi;
  char library[MOST_TEXT], token[MOST_TEXT], resources[MOST_TEXT];
  signal_of_fmu in[MOST_SIGNALS], out[MOST_SIGNALS];
  parameter_of_fmu parameter[MOST_SIGNALS];
  unsigned ins, outs, parameters;
  void *handle, *instance;
  fmi2_callbacks callbacks;
  unsigned long long steps;
  char said[AMBRIG_CONTROLLER_MESSAGE]; /* by its logger, last */
} fmu;

int is_fmu_binding(const char *library) {
  const char *end = ".fmu-binding";
  const size_t n = strlen(library), m = strlen(end);
  return n > m && strcmp(library + n - m, end) == 0;
}

static void log2_of_fmu(void *environment, const char *name, int status, const char *category, const char *message, ...) {
  va_list list;
  (void)environment, (void)name, (void)category;
  if (status < 2) return; /* OK, Warning */
  va_start(list, message);
  vsnprintf(fmu.said, sizeof fmu.said, message, list);
  va_end(list);
}

static void log3_of_fmu(void *environment, int status, const char *category, const char *message) {
  (void)environment, (void)category;
  if (status >= 2) snprintf(fmu.said, sizeof fmu.said, "%s", message);
}

/* A function by its name into *place, a pointer to a function; POSIX says that this conversion works. */
static int find(const char *name, void *place) {
  void *p = dlsym(fmu.handle, name);
  memcpy(place, &p, sizeof p);
  return p != NULL;
}

static int failed(ambrig_controller *c, const char *function, int status) {
  char text[AMBRIG_CONTROLLER_MESSAGE + 96];
  if (status < 2) return 0;
  snprintf(text, sizeof text, "%s of the FMU returned %s%s%s", function,
           status == 2 ? "Discard" : status == 3 ? "Error" : "Fatal", fmu.said[0] ? ": " : "", fmu.said);
  return ambrig_fail(c, text);
}

static int missing(ambrig_controller *c, const char *function) {
  char text[96];
  snprintf(text, sizeof text, "the FMU has no function %s", function);
  return ambrig_fail(c, text);
}

static const char *read_line(char *line) {
  char *end = line + strcspn(line, "\n");
  *end = '\0';
  if (sscanf(line, "fmi %d", &fmu.fmi) == 1) return NULL;
  if (strncmp(line, "library ", 8) == 0) return strcpy(fmu.library, line + 8), NULL;
  if (strncmp(line, "token ", 6) == 0) return strcpy(fmu.token, line + 6), NULL;
  if (strncmp(line, "resources ", 10) == 0) return strcpy(fmu.resources, line + 10), NULL;
  if (fmu.ins >= MOST_SIGNALS || fmu.outs >= MOST_SIGNALS || fmu.parameters >= MOST_SIGNALS)
    return "has more variables than there is room for";
  signal_of_fmu s;
  if (sscanf(line, "in %15s %u %u", s.field, &s.index, &s.reference) == 3) return fmu.in[fmu.ins++] = s, NULL;
  if (sscanf(line, "out %15s %u %u", s.field, &s.index, &s.reference) == 3) return fmu.out[fmu.outs++] = s, NULL;
  parameter_of_fmu *p = &fmu.parameter[fmu.parameters];
  if (sscanf(line, "parameter %c %u %la", &p->type, &p->reference, &p->value) == 3) return ++fmu.parameters, NULL;
  return "has a binding that cannot be read";
}

const char *load_fmu(const char *binding) {
  static char line[MOST_TEXT], text[512];
  FILE *file = fopen(binding, "r");
  const char *wrong = file ? NULL : "has a binding that cannot be opened";
  while (!wrong && fgets(line, sizeof line, file)) wrong = read_line(line);
  if (file) fclose(file);
  if (wrong) return wrong;
  fmu.handle = dlopen(fmu.library, RTLD_NOW | RTLD_LOCAL);
  if (fmu.handle) return NULL;
  snprintf(text, sizeof text, "cannot be loaded: %s", dlerror());
  return text;
}

static int instantiate(ambrig_controller *c) {
  void *(*two)(const char *, int, const char *, const char *, const fmi2_callbacks *, int, int);
  void *(*three)(const char *, const char *, const char *, bool, bool, bool, bool, const unsigned *, size_t, void *,
                 void (*)(void *, int, const char *, const char *), void *);
  char place[MOST_TEXT + 16];
  if (fmu.fmi == 2) {
    if (!find("fmi2Instantiate", &two)) return missing(c, "fmi2Instantiate");
    fmu.callbacks.logger = log2_of_fmu;
    fmu.callbacks.allocate = calloc;
    fmu.callbacks.release = free;
    snprintf(place, sizeof place, "file://%s", fmu.resources);
    fmu.instance = two("controller", 1, fmu.token, place, &fmu.callbacks, 0, 0);
  } else {
    if (!find("fmi3InstantiateCoSimulation", &three)) return missing(c, "fmi3InstantiateCoSimulation");
    snprintf(place, sizeof place, "%s/", fmu.resources);
    fmu.instance = three("controller", fmu.token, place, false, false, false, false, NULL, 0, NULL, log3_of_fmu, NULL);
  }
  return fmu.instance ? 0 : failed(c, "instantiation", 3);
}

/* One real number in (`get` 0) or out. */
static int move_real(ambrig_controller *c, int get, unsigned reference, double *value) {
  set_real2 two;
  set_real3 three;
  const char *name = fmu.fmi == 2 ? (get ? "fmi2GetReal" : "fmi2SetReal") : (get ? "fmi3GetFloat64" : "fmi3SetFloat64");
  if (fmu.fmi == 2)
    return find(name, &two) ? failed(c, name, two(fmu.instance, &reference, 1, value)) : missing(c, name);
  return find(name, &three) ? failed(c, name, three(fmu.instance, &reference, 1, value, 1)) : missing(c, name);
}

static int set_parameter(ambrig_controller *c, parameter_of_fmu *p) {
  int whole = (int)p->value, (*ints)(void *, const unsigned *, size_t, const int *, size_t),
      (*longs)(void *, const unsigned *, size_t, const int64_t *, size_t),
      (*bools)(void *, const unsigned *, size_t, const bool *, size_t);
  int64_t longer = (int64_t)p->value;
  bool yes = p->value != 0;
  set_int2 two;
  if (p->type == 'r') return move_real(c, 0, p->reference, &p->value);
  if (p->type == 'b') whole = yes;
  if (fmu.fmi == 2) {
    const char *name = p->type == 'b' ? "fmi2SetBoolean" : "fmi2SetInteger";
    return find(name, &two) ? failed(c, name, two(fmu.instance, &p->reference, 1, &whole)) : missing(c, name);
  }
  if (p->type == 'b')
    return find("fmi3SetBoolean", &bools) ? failed(c, "fmi3SetBoolean", bools(fmu.instance, &p->reference, 1, &yes, 1))
                                          : missing(c, "fmi3SetBoolean");
  if (p->type == 'l')
    return find("fmi3SetInt64", &longs) ? failed(c, "fmi3SetInt64", longs(fmu.instance, &p->reference, 1, &longer, 1))
                                        : missing(c, "fmi3SetInt64");
  return find("fmi3SetInt32", &ints) ? failed(c, "fmi3SetInt32", ints(fmu.instance, &p->reference, 1, &whole, 1))
                                     : missing(c, "fmi3SetInt32");
}

int fmu_open(ambrig_controller *c) {
  int (*setup)(void *, int, double, double, int, double), (*enter3)(void *, bool, double, double, bool, double);
  plain enter, leave;
  const char *leaving = fmu.fmi == 2 ? "fmi2ExitInitializationMode" : "fmi3ExitInitializationMode";
  unsigned k;
  if (instantiate(c)) return 1;
  for (k = 0; k < fmu.parameters; ++k)
    if (set_parameter(c, &fmu.parameter[k])) return 1;
  if (fmu.fmi == 2) {
    if (!find("fmi2SetupExperiment", &setup)) return missing(c, "fmi2SetupExperiment");
    if (failed(c, "fmi2SetupExperiment", setup(fmu.instance, 0, 0, 0, 0, 0))) return 1;
    if (!find("fmi2EnterInitializationMode", &enter)) return missing(c, "fmi2EnterInitializationMode");
    if (failed(c, "fmi2EnterInitializationMode", enter(fmu.instance))) return 1;
  } else {
    if (!find("fmi3EnterInitializationMode", &enter3)) return missing(c, "fmi3EnterInitializationMode");
    if (failed(c, "fmi3EnterInitializationMode", enter3(fmu.instance, false, 0, 0, false, 0))) return 1;
  }
  return find(leaving, &leave) ? failed(c, leaving, leave(fmu.instance)) : missing(c, leaving);
}

static const double *input_field(const ambrig_controller *c, const char *name) {
  if (strcmp(name, "position") == 0) return c->position;
  if (strcmp(name, "reference") == 0) return c->reference;
  if (strcmp(name, "excitation") == 0) return c->excitation;
  if (strcmp(name, "current") == 0) return c->current;
  if (strcmp(name, "set_point") == 0) return c->set_point;
  return strcmp(name, "duty") == 0 ? c->duty : &c->speed;
}

static int do_step(ambrig_controller *c) {
  int (*two)(void *, double, double, int), (*three)(void *, double, double, bool, bool *, bool *, bool *, double *);
  const double t = (double)fmu.steps * c->period;
  bool event = false, end = false, early = false;
  double last = 0;
  ++fmu.steps;
  if (fmu.fmi == 2)
    return find("fmi2DoStep", &two) ? failed(c, "fmi2DoStep", two(fmu.instance, t, c->period, 1)) : missing(c, "fmi2DoStep");
  if (!find("fmi3DoStep", &three)) return missing(c, "fmi3DoStep");
  if (failed(c, "fmi3DoStep", three(fmu.instance, t, c->period, true, &event, &end, &early, &last))) return 1;
  return end ? ambrig_fail(c, "the FMU asked to end the simulation") : 0;
}

int fmu_step(ambrig_controller *c) {
  unsigned k;
  for (k = 0; k < fmu.ins; ++k) {
    double value = input_field(c, fmu.in[k].field)[fmu.in[k].index];
    if (move_real(c, 0, fmu.in[k].reference, &value)) return 1;
  }
  if (do_step(c)) return 1;
  for (k = 0; k < fmu.outs; ++k) {
    double *to = strcmp(fmu.out[k].field, "force") == 0 ? c->force : c->command;
    if (move_real(c, 1, fmu.out[k].reference, &to[fmu.out[k].index])) return 1;
  }
  return 0;
}

void fmu_close(ambrig_controller *c) {
  plain end;
  void (*release)(void *);
  (void)c;
  if (!fmu.instance) return;
  if (find(fmu.fmi == 2 ? "fmi2Terminate" : "fmi3Terminate", &end)) end(fmu.instance);
  if (find(fmu.fmi == 2 ? "fmi2FreeInstance" : "fmi3FreeInstance", &release)) release(fmu.instance);
}
