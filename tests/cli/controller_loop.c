/* A generated controller in a loop around plant (12), against the same sampled loop in double with full memory, which
 * shares no code with it: every sum from its first sample on, weights by their recursion. Prints, as a share of the
 * largest output, `deviation` of the header's loop, and `sampling`, what half the step changes in the loop in double.
 *
 * -DHEADER="pid.h", and the controller's numbers: KP KI KD LAMBDA MU FILTER WEIGHT; -DQ31 for a header in that format. */
#include HEADER

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { samples = 12000 };

#ifdef Q31
static pid_q31_instance line;
static void initialise(void) { pid_init_q31(&line); }
static double real_of(int32_t u) { return u * (PID_Q31_OUTPUT_FULL_SCALE / 2147483648.0); }
static double step(double r, double y) { return real_of(pid_step_q31(&line, PID_Q31_INPUT(r), PID_Q31_INPUT(y))); }
static void start(double r, double y, double u)
{
    pid_start_q31(&line, PID_Q31_INPUT(r), PID_Q31_INPUT(y), PID_Q31_OUTPUT(u));
}
static void set_gains(double kp, double ki, double kd)
{
    pid_set_gains_q31(&line, PID_Q31_KP(kp), PID_Q31_KI(ki), PID_Q31_KD(kd));
}
static uint32_t self_check(void) { return pid_self_check_q31(&line); }
/* The highest that 32 bits hold is a unit below full scale; what lies beyond it saturates. */
static const double highest = 2.0 - 2.0 / 2147483648.0;
static int saturates(void)
{
    return PID_Q31_INPUT(1e9) == INT32_MAX && PID_Q31_INPUT(-1e9) == INT32_MIN &&
           PID_Q31_INPUT(1.5 * PID_Q31_INPUT_FULL_SCALE) == INT32_MAX &&
           PID_Q31_INPUT(0.5 * PID_Q31_INPUT_FULL_SCALE) == INT32_C(1) << 30 &&
           PID_Q31_INPUT(-0.5 * PID_Q31_INPUT_FULL_SCALE) == -(INT32_C(1) << 30);
}
#else
static pid_f32_instance line;
static void initialise(void) { pid_init_f32(&line); }
static double step(double r, double y) { return (double)pid_step_f32(&line, (float)r, (float)y); }
static void start(double r, double y, double u) { pid_start_f32(&line, (float)r, (float)y, (float)u); }
static void set_gains(double kp, double ki, double kd) { pid_set_gains_f32(&line, (float)kp, (float)ki, (float)kd); }
static uint32_t self_check(void) { return pid_self_check_f32(&line); }
static const double highest = 2.0;
static int saturates(void) { return 1; }
#endif

static double *weights_of(double order, double factor, int count, double *sum)
{
    double weight = factor;
    int j;
    for (j = 0; j < count; ++j) {
        sum[j] += weight;
        weight *= 1.0 - (1.0 + order) / (j + 1);
    }
    return sum;
}

static double sum_of(const double *weights, const double *x, int k)
{
    double sum = 0.0;
    int j;
    for (j = k; j >= 0; --j) {
        sum += weights[j] * x[k - j];
    }
    return sum;
}

/* The output at each sample, with the header in the loop or without it. */
static void run(double h, int count, int with_header, double *output)
{
    const int delay = (int)(1.0 / h + 0.5);
    double *plant = calloc((size_t)count, sizeof *plant);
    double *integral = calloc((size_t)count, sizeof *plant);
    double *derivative = calloc((size_t)count, sizeof *plant);
    double *u = calloc((size_t)count, sizeof *plant);
    double *e = calloc((size_t)count, sizeof *plant);
    double *w = calloc((size_t)count, sizeof *plant);
    double d = 0.0;
    int k;
    weights_of(1.9909, 0.18234 * pow(h, -1.9909), count, plant);
    weights_of(0.98319, 0.65536 * pow(h, -0.98319), count, plant);
    plant[0] += 0.9992;
    weights_of(-LAMBDA, KI * pow(h, LAMBDA), count, integral);
    weights_of(MU, KD * pow(h, -MU), count, derivative);
    initialise();
    for (k = 0; k < count; ++k) {
        const double setpoint = 2 * k < count ? 1.0 : 0.4;
        const double first = plant[0];
        output[k] = 0.0;
        if (k > 0) {
            const double forcing = k - 1 - delay >= 0 ? u[k - 1 - delay] : 0.0;
            output[k] = (forcing - sum_of(plant, output, k)) / first;
        }
        e[k] = setpoint - output[k];
        w[k] = WEIGHT * setpoint - output[k];
        if (with_header) {
            u[k] = step(setpoint, output[k]);
        } else {
            d += h / (h + FILTER) * (sum_of(derivative, w, k) - d);
            u[k] = KP * w[k] + sum_of(integral, e, k) + d;
        }
    }
    free(plant);
    free(integral);
    free(derivative);
    free(u);
    free(e);
    free(w);
}

/* What a start and a change of gains make the output jump by; then whether limits hold and nothing winds up. */
static int behaves(void)
{
    double before = 0.0;
    double after;
    int k;
    if (self_check() != 0U) {
        return puts("self-check failed"), 0;
    }
    if (!saturates()) {
        return puts("a constant beyond full scale does not saturate"), 0;
    }
    start(0.3, 0.3, 0.7);
    after = step(0.3, 0.3);
    if (fabs(after - 0.7) > 2e-3 * (1.0 + KD)) {
        return printf("started at %g instead of 0.7\n", after), 0;
    }
    for (k = 0; k < 500; ++k) {
        before = step(0.5, 0.3);
    }
    set_gains(2.0 * KP, KI, 0.5 * KD);
    after = step(0.5, 0.3);
    if (fabs(after - before) > 5e-3) {
        return printf("a change of gains moved the output from %g to %g\n", before, after), 0;
    }
    initialise();
    for (k = 0; k < 100000; ++k) {
        if (step(1.0, 0.0) > highest) {
            return puts("above its limit"), 0;
        }
    }
    if (step(1.0, 0.0) != highest) {
        return puts("never at its limit"), 0;
    }
    for (k = 0; k < 3000; ++k) {
        after = step(0.0, 1.0);
    }
    return after < 1.0 ? 1 : (printf("wound up: %g after three seconds of the other error\n", after), 0);
}

/* Of orders (1, 1) without a filter: the usual PID of three coefficients, in velocity form. */
static int is_three_coefficients(void)
{
    const double h = 0.001;
    double x[3] = {0.0, 0.0, 0.0};
    double u = 0.0;
    int k;
    initialise();
    for (k = 0; k < 20000; ++k) {
        const double own = step((double)(0.1F * (float)sin(0.01 * k)), 0.0);
        x[2] = x[1];
        x[1] = x[0];
        x[0] = (double)(0.1F * (float)sin(0.01 * k));
        u += (KP + KI * h + KD / h) * x[0] - (KP + 2.0 * KD / h) * x[1] + KD / h * x[2];
        if (fabs(own - u) > 1e-6) {
            return printf("sample %d: %.9g where three coefficients give %.9g\n", k, own, u), 0;
        }
    }
    return 1;
}

int main(void)
{
    static double exact[samples];
    static double half[2 * samples];
    static double own[samples];
    double deviation = 0.0;
    double sampling = 0.0;
    double largest = 0.0;
    int k;
    if (!behaves() || (LAMBDA == 1 && MU == 1 && FILTER == 0 && !is_three_coefficients())) {
        return 1;
    }
    run(0.001, samples, 0, exact);
    run(0.0005, 2 * samples, 0, half);
    run(0.001, samples, 1, own);
    for (k = 0; k < samples; ++k) {
        largest = fmax(largest, fabs(exact[k]));
        deviation = fmax(deviation, fabs(own[k] - exact[k]));
        sampling = fmax(sampling, fabs(half[2 * k] - exact[k]));
    }
    printf("deviation %.3g sampling %.3g of %.3g\n", deviation / largest, sampling / largest, largest);
    return deviation <= 1e-4 * largest ? 0 : 1;
}
