#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

int ambrig_controller_open(ambrig_controller *c) { return c->axes == 0; }
