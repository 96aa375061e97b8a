/* A Functional Mock-up Unit (FMI 2.0 or 3.0, co-simulation) as a controller.
 *
 * What ambrig hands over as the controller's library is then a text file, its binding, NAME.fmu-binding:
 *
 *   fmi 2|3
 *   library PATH                         of the unpacked FMU
 *   token TEXT                           guid or instantiationToken
 *   resources PATH
 *   parameter r|i|l|b REFERENCE VALUE    Real or Float64, Integer or Int32, Int64, Boolean; set once
 *   in FIELD INDEX REFERENCE             field of ambrig_controller.h, before every step
 *   out FIELD INDEX REFERENCE            after it
 *
 * The FMU's time begins at 0; a step of it is a period of the controller.
 */
#ifndef AMBRIG_FMU_ADAPTER_H
#define AMBRIG_FMU_ADAPTER_H

struct ambrig_controller;

/* Whether this is the name of a binding. */
int is_fmu_binding(const char* library);

/* Reads the binding and loads the FMU's library. Returns NULL, or what is wrong. */
const char* load_fmu(const char* binding);

int fmu_open(struct ambrig_controller* c);
int fmu_step(struct ambrig_controller* c);
void fmu_close(struct ambrig_controller* c);

#endif
