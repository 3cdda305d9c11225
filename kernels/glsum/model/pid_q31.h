/* The statements of pid.h in q31, in C99 and C++ alike: the library's tests compile this text, and a generated header
 * holds it, but for its names.
 *
 *   u = kp w + ki D^-lambda e + kd F D^mu w,     e = r - y,     w = b r - y,     F the filter of the derivative
 *
 * Every number is an integer, a fraction of a full scale: r and y of the input's, e and w of twice that, which no r and
 * y leave; u of the output's. A gain is 32 bits that its own shift brings to the units of the integral, and those are
 * the output's with further bits behind. Full scales, products and added sums together fill half of what its 64 bits
 * hold at most (bench/steppers/controller/fixed_pid sees to it), so that nothing overflows, whatever the samples and
 * the gains are. Every product is rounded once, to nearest, halves up. Where u meets a limit it stays there, and the
 * integral waits.
 *
 * Before the inclusion: GLSUM_PID_ROUND(value, shift), value 2^-shift to nearest as 32 bits, saturated;
 * GLSUM_PID_NUMBER(name), a number of the design: SHIFT_KP, SHIFT_KI, SHIFT_KD, from the products to the integral's
 * units; EXTRA, how many bits those have behind the output's; WEIGHT, b 2^30; PASSES 2^-PASSES_SHIFT, what the filter
 * lets through with each sample; GLSUM_PID_DESIGN, fields that hold them or nothing. */
typedef struct {
    int64_t integral;
    int32_t kp;
    int32_t ki; /* times h^lambda */
    int32_t kd; /* times h^-mu */
    int32_t low;
    int32_t high;
    int32_t weighted;   /* w of the last sample */
    int32_t derivative; /* F D^mu w of the last sample, in units of its sum */
    GLSUM_PID_DESIGN
} glsum_pid;

/* A gain's product in units of the integral. */
static inline int64_t glsum_pid_product(int32_t gain, int32_t value, int shift)
{
    const int64_t product = (int64_t)gain * value;
    return shift > 0 ? ((product >> (shift - 1)) + 1) >> 1 : product;
}

/* r - y and b r - y as fractions of twice their full scale. */
static inline int32_t glsum_pid_error(int32_t setpoint, int32_t measured)
{
    return GLSUM_PID_ROUND((int64_t)setpoint - measured, 1);
}
static inline int32_t glsum_pid_weighted(const glsum_pid *S, int32_t setpoint, int32_t measured)
{
    const int64_t one = (int64_t)1 << 30;
    (void)S;
    return GLSUM_PID_ROUND(GLSUM_PID_NUMBER(WEIGHT) * (int64_t)setpoint - one * measured, 31);
}

/* What acts at once. */
static inline int64_t glsum_pid_direct(const glsum_pid *S)
{
    return glsum_pid_product(S->kp, S->weighted, GLSUM_PID_NUMBER(SHIFT_KP)) +
           glsum_pid_product(S->kd, S->derivative, GLSUM_PID_NUMBER(SHIFT_KD));
}

/* Begins at an output: with no error it stays there. */
static inline void glsum_pid_start(glsum_pid *S, int32_t weighted, int32_t output)
{
    S->weighted = weighted;
    S->derivative = 0;
    S->integral = output * ((int64_t)1 << GLSUM_PID_NUMBER(EXTRA)) - glsum_pid_direct(S);
}

/* Other gains, times their powers of h; the output goes on from where it is, to the bit. Whoever turns gains to and fro
 * at a limit would pile the integral up: it ends at a half of its range, beyond all that one set of gains makes. */
static inline void glsum_pid_change(glsum_pid *S, int32_t kp, int32_t ki, int32_t kd)
{
    const int64_t most = (int64_t)1 << 62;
    int64_t moved = glsum_pid_direct(S);
    S->kp = kp;
    S->ki = ki;
    S->kd = kd;
    moved = S->integral + (moved - glsum_pid_direct(S));
    S->integral = moved > most ? most : moved < -most ? -most : moved;
}

/* u for w, the sum of order 1 - lambda over e and that of order mu over w. */
static inline int32_t glsum_pid_step(glsum_pid *S, int32_t weighted, int32_t integral_sum, int32_t derivative_sum)
{
    const int64_t passes = GLSUM_PID_NUMBER(PASSES);
    const int64_t half = (int64_t)1 << (GLSUM_PID_NUMBER(PASSES_SHIFT) - 1);
    const int64_t moves = passes * derivative_sum - passes * S->derivative;
    const int64_t added = glsum_pid_product(S->ki, integral_sum, GLSUM_PID_NUMBER(SHIFT_KI));
    const int64_t after = S->integral + added;
    int64_t output;
    S->weighted = weighted;
    S->derivative = (int32_t)(S->derivative + ((moves + half) >> GLSUM_PID_NUMBER(PASSES_SHIFT)));
    output = (((after + glsum_pid_direct(S)) >> (GLSUM_PID_NUMBER(EXTRA) - 1)) + 1) >> 1;
    if (output > S->high && added > 0) {
        return S->high; /* the integral waits */
    }
    if (output < S->low && added < 0) {
        return S->low;
    }
    S->integral = after;
    return output > S->high ? S->high : output < S->low ? S->low : (int32_t)output;
}
