/* Right-hand sides for GSL as its users write them: plain C, parameters in an array, called by GSL
 * itself. y is (q, v), f its rate; nothing is damped or driven. A test compares each with the
 * accelerations of its system.
 *
 * fpm gives C no flags of the profile: without the pragma GSL would be measured unoptimised. */
#pragma GCC optimize("O3")
#include <math.h>

typedef struct {
    double p[9];      /* parameters, in the order of `describe` */
    long evaluations; /* so far */
} context_t;

int lagrangia_rates_oscillator(double t, const double y[], double f[], void *context)
{
    context_t *c = context;
    (void)t;
    f[0] = y[1];
    f[1] = -c->p[1] / c->p[0] * y[0];
    c->evaluations++;
    return 0;
}

int lagrangia_rates_pendulum(double t, const double y[], double f[], void *context)
{
    context_t *c = context;
    (void)t;
    f[0] = y[1];
    f[1] = -c->p[2] / c->p[1] * sin(y[0]);
    c->evaluations++;
    return 0;
}

int lagrangia_rates_double_pendulum(double t, const double y[], double f[], void *context)
{
    context_t *c = context;
    const double m1 = c->p[0], m2 = c->p[1], l1 = c->p[2], l2 = c->p[3], g = c->p[4];
    const double s = sin(y[0] - y[1]), k = cos(y[0] - y[1]), s1 = sin(y[0]), k1 = cos(y[0]);
    const double d = m1 + m2 * s * s, w1 = l1 * y[2] * y[2], w2 = l2 * y[3] * y[3];
    (void)t;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = -(m1 * g * s1 + m2 * s * (w1 * k + w2 + g * (k1 * k + s1 * s))) / (l1 * d);
    f[3] = s * ((m1 + m2) * (w1 + g * k1) + m2 * w2 * k) / (l2 * d);
    c->evaluations++;
    return 0;
}

int lagrangia_rates_cart_pendulum(double t, const double y[], double f[], void *context)
{
    context_t *c = context;
    const double m1 = c->p[0], m2 = c->p[1], l = c->p[2], g = c->p[3];
    const double s = sin(y[1]), k = cos(y[1]), d = m1 + m2 * s * s, w = l * y[3] * y[3];
    (void)t;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = m2 * s * (w + g * k) / d;
    f[3] = -s * ((m1 + m2) * g + m2 * w * k) / (l * d);
    c->evaluations++;
    return 0;
}

int lagrangia_rates_charged_particle(double t, const double y[], double f[], void *context)
{
    context_t *c = context;
    const double *e = c->p + 2, *b = c->p + 5, r = c->p[1] / c->p[0], k = c->p[8] / c->p[0];
    (void)t;
    f[0] = y[3];
    f[1] = y[4];
    f[2] = y[5];
    f[3] = r * (e[0] + y[4] * b[2] - y[5] * b[1]) - k * y[0];
    f[4] = r * (e[1] + y[5] * b[0] - y[3] * b[2]) - k * y[1];
    f[5] = r * (e[2] + y[3] * b[1] - y[4] * b[0]) - k * y[2];
    c->evaluations++;
    return 0;
}
