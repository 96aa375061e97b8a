/* The law of the test's controllers. */
typedef struct plain_pi {
  double sum, last, rate;
} plain_pi;

static double plain_pi_step(plain_pi* s, double kp, double error, double h) {
  const double slope = (error - s->last) / h;
  s->rate += 0.35 * (slope - s->rate);
  s->last = error;
  s->sum += error * h;
  return kp * error + 900.0 * s->rate + 6.0e6 * s->sum;
}
