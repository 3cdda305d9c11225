/* The statements of a fractional PID controller around its two sums, in C99 and C++ alike: the library's tests compile
 * this text, and a generated header holds it, but for its names.
 *
 *   u = kp w + ki D^-lambda e + kd F D^mu w,     e = r - y,     w = b r - y,     F the filter of the derivative
 *
 * The integral is the plain sum of the derivative of order 1 - lambda of e, so that it is a number of its own: it stops
 * where u meets a limit and would be driven beyond it, and it takes up what a change of gains would make u jump by.
 * It carries what its additions lost [Dekker1971]. D^mu w passes d <- d + passes (D^mu w - d), the backward Euler form
 * of 1 / (filter_s s + 1): passes = h / (h + filter_s).
 *
 * Before the inclusion: GLSUM_REAL, the type of all numbers; GLSUM_PID_KEEP(value), which lets nobody fuse what made it. */
typedef struct {
    GLSUM_REAL kp;
    GLSUM_REAL ki; /* times h^lambda */
    GLSUM_REAL kd; /* times h^-mu */
    GLSUM_REAL passes;
    GLSUM_REAL low;
    GLSUM_REAL high;
    GLSUM_REAL integral;
    GLSUM_REAL lost;       /* of the integral, by its last addition */
    GLSUM_REAL weighted;   /* w of the last sample */
    GLSUM_REAL derivative; /* d of the last sample, before kd */
} glsum_pid;

static inline GLSUM_REAL glsum_pid_product(GLSUM_REAL a, GLSUM_REAL b)
{
    GLSUM_REAL product = a * b;
    GLSUM_PID_KEEP(product);
    return product;
}

/* Begins at an output: with no error it stays there. */
static inline void glsum_pid_start(glsum_pid *S, GLSUM_REAL weighted, GLSUM_REAL output)
{
    S->integral = output - glsum_pid_product(S->kp, weighted);
    S->lost = 0;
    S->weighted = weighted;
    S->derivative = 0;
}

/* Other gains, times their powers of h; the output goes on from where it is. */
static inline void glsum_pid_change(glsum_pid *S, GLSUM_REAL kp, GLSUM_REAL ki, GLSUM_REAL kd)
{
    S->integral +=
        glsum_pid_product(S->kp - kp, S->weighted) + glsum_pid_product(S->kd - kd, S->derivative);
    S->kp = kp;
    S->ki = ki;
    S->kd = kd;
}

/* u for w, the sum of order 1 - lambda over e and that of order mu over w. */
static inline GLSUM_REAL glsum_pid_step(glsum_pid *S, GLSUM_REAL weighted, GLSUM_REAL integral_sum,
                                        GLSUM_REAL derivative_sum)
{
    const GLSUM_REAL derivative =
        S->derivative + glsum_pid_product(S->passes, derivative_sum - S->derivative);
    const GLSUM_REAL direct = glsum_pid_product(S->kp, weighted) + glsum_pid_product(S->kd, derivative);
    const GLSUM_REAL before = S->integral;
    const GLSUM_REAL added = glsum_pid_product(S->ki, integral_sum) + S->lost;
    const GLSUM_REAL after = before + added;
    const GLSUM_REAL output = after + direct;
    S->weighted = weighted;
    S->derivative = derivative;
    if (output > S->high && added > 0) {
        return S->high; /* the integral waits */
    }
    if (output < S->low && added < 0) {
        return S->low;
    }
    S->integral = after;
    S->lost = added - (after - before);
    return output > S->high ? S->high : output < S->low ? S->low : output;
}
