/* Some library that is no controller. */
int ambrig_controller_open(void *c) { return c == 0; }
