/* The integration loop of explicit Runge-Kutta methods, one motion a thread: what crates/integrate does for motions without
 * trouble. Its arithmetic, constants and names are those of the files there; see them for the reasons.
 *
 * In each turn of its loop, a thread tries one step of its motion, of its own length. A thread whose motion has ended takes
 * the next case at once, so no thread waits for another one before the last cases. A motion that meets trouble (a rate that is not finite, a
 * step that collapses, a singular position, an energy balance that is off) leaves with that status: the host
 * integrates it again, by the native integrator, which knows the ways out and says what was the matter. */

/* How a motion ended; `Ending` in kernel.py. From NOT_FINITE on, the host takes it. */
enum { RUNNING, COMPLETED, ENDED_BY_EVENT, NOT_FINITE, COLLAPSED, STALLED, DEFICIENT, UNBALANCED, SINGULAR, CROWDED, AT_POLE };

#define SAFETY 0.8
#define MEMORY 0.04
#define LEAST_ERROR 1e-4
#define SHRINK 0.333
#define GROW 6.0
#define STIFF_STEPS 15
#define INTEGRAL 10.0
#define STALLED_STEPS 100000
#define STALLED_PART 1e-4
#define PARTS 10
#define EXPONENT (1.0 / (double)ORDER)

/* A loop over the entries of a vector, unrolled where vectors are short enough for registers. */
#define EACH(i, n) UNROLL for (int i = 0; i < (n); ++i)

/* What all motions share, and the arrays of their numbers, a row for each case. */
struct Batch {
    long long cases, instants, most_events;
    double relative, absolute, max_step;
    const double *t;               /* the instants */
    const double *starts;          /* cases x WIDTH */
    const double *parameters;      /* cases x PARAMETERS */
    double *states;                /* cases x instants x WIDTH */
    double *ends;                  /* cases x 1: the instant of the end */
    double *events;                /* cases x most_events x (2 + WIDTH): number, instant, state */
    long long *counts;             /* cases x COUNTS, as below */
    unsigned long long *queue;     /* the next case, and how many have ended */
};

/* The columns of counts. */
enum { STATUS, REACHED, STEPS, REJECTED, EVALUATIONS, STIFF, HAPPENED, COUNTS };

/* A motion in progress. */
struct Lane {
    long long number;              /* its case, or -1 */
    long long reached, steps, rejected, evaluations, happened, stiff;
    int deficient, stiff_steps, was_rejected, is_finite, begins;
    double t, step, last_error, errors, checked;
    double last_t, last_h;         /* the start and the length of the last step */
    double c[CONSTANTS + 1];       /* what the functions need of the parameters */
    double x[WIDTH], before[WIDTH], after[WIDTH], last_stage[WIDTH], sizes[WIDTH], origin[WIDTH];
    double k[ROWS][WIDTH];         /* the rates at the stages */
    double fastest;                /* the largest speed so far, of `Branch` */
    double first, first_potential, moving, largest, spread, least_spread, off;    /* the balance of energy */
    long long looks;
    double values[EVENTS + 1], seen;    /* the functions of events, and until when they are checked */
};

static __device__ int are_finite(int n, const double *x)
{
    int all = 1;
    EACH(i, n) all &= isfinite(x[i]) != 0;
    return all;
}

static __device__ double squared_distance(int n, const double *x, const double *y)
{
    double sum = 0.0;
    EACH(i, n) sum += (x[i] - y[i])*(x[i] - y[i]);
    return sum;
}

static __device__ double largest_of(int n, const double *x)
{
    double most = 0.0;
    EACH(i, n) most = fmax(most, fabs(x[i]));
    return most;
}

/* The root mean square of a vector in units of the tolerance. */
static __device__ double weighted(const Batch *batch, const Lane *lane, const double *vector)
{
    double sum = 0.0;
    EACH(i, CONTROLLED) {
        const double part = vector[i]/(batch->absolute + batch->relative*fabs(lane->x[i]));
        sum += part*part;
    }
    return sqrt(sum/(double)CONTROLLED);
}

static __device__ double tolerance_of_integral(const Batch *batch, const Lane *lane, int i, double h)
{
    double steepest = 0.0;
    EACH(stage, STAGES) steepest = fmax(steepest, fabs(lane->k[stage][i]));
    return INTEGRAL*(batch->absolute
        + batch->relative*fmax(fmax(lane->sizes[i], fabs(lane->after[i])), fabs(h)*steepest));
}

/* The sum of the squares of an error in units of the tolerance. */
static __device__ double weighted_square(const Batch *batch, const Lane *lane, const double *error, double h)
{
    double sum = 0.0, of_integrals = 0.0;
    EACH(i, CONTROLLED) {
        const double weight = 1.0/(batch->absolute + batch->relative*fmax(fabs(lane->x[i]), fabs(lane->after[i])));
        sum += (error[i]*weight)*(error[i]*weight);
    }
    for (int i = CONTROLLED; i < WIDTH; ++i) {
        const double part = error[i]/tolerance_of_integral(batch, lane, i, h);
        of_integrals += part*part;
    }
    return sum + of_integrals;
}

static __device__ double weighted_error(const Batch *batch, const Lane *lane, double errors[ESTIMATES][WIDTH], double h)
{
    const double entries = (double)CONTROLLED, high = weighted_square(batch, lane, errors[0], h);
    if (ESTIMATES == 1) return fabs(h)*sqrt(high/entries);
    const double both = high + 0.01*weighted_square(batch, lane, errors[ESTIMATES - 1], h);
    return both <= 0.0 ? 0.0 : fabs(h)*high/sqrt(both*entries);
}

/* What the coefficients of a method make of these, written after this file by method_text.py: the stages of a step, the
 * state at its end and the estimates of its error; the further stages of the dense output; its terms beyond a cubic. */
static __device__ void take_stages(Lane *lane, double h, double errors[ESTIMATES][WIDTH]);
static __device__ void add_stages(Lane *lane);
static __device__ void add_terms(const Lane *lane, double h, double dense[TERMS][WIDTH]);

static __device__ void evaluate(Lane *lane, double t, const double *x, double *out)
{
    rates_at(t, x, lane->c, out, &lane->deficient);
    lane->evaluations += 1;
}

/* Guess the first step from the rates and their change. */
static __device__ __noinline__ double first_step(const Batch *batch, Lane *lane, double end)
{
    const double longest = fmin(batch->max_step, end - lane->t);
    double y[WIDTH], change[WIDTH];
    evaluate(lane, lane->t, lane->x, lane->k[0]);
    const double size = weighted(batch, lane, lane->x), rate = weighted(batch, lane, lane->k[0]);
    const double trial = fmin(size < 1e-5 || rate < 1e-5 ? 1e-6 : 0.01*size/rate, longest);
    EACH(i, WIDTH) y[i] = lane->x[i] + trial*lane->k[0][i];
    evaluate(lane, lane->t + trial, y, lane->k[1]);
    EACH(i, WIDTH) change[i] = lane->k[1][i] - lane->k[0][i];
    const double steepest = fmax(rate, weighted(batch, lane, change)/trial);
    const double step = steepest <= 1e-15 ? fmax(trial*1e-3, 1e-6) : pow(0.01/steepest, EXPONENT);
    const double bounded = fmin(fmin(step, 100.0*trial), longest);
    return isfinite(bounded) ? bounded : trial;
}

/* --- the balance of energy: energy_balance.rs ------------------------------------------------------------------------ */

#if ENERGIES
static __device__ double work_of(const double *x)
{
    return WIDTH > CONTROLLED ? x[CONTROLLED % WIDTH] : 0.0;
}

static __device__ int energies_of(Lane *lane, double t, const double *x, double *energies)
{
    energies_at(t, x, lane->c, energies, &lane->deficient);
    return are_finite(2, energies);
}

/* Update the largest change of the energy by errors of one tolerance in each entry, and the least by errors of one
 * absolute tolerance, which the host takes the median of. */
static __device__ __noinline__ void widen(const Batch *batch, Lane *lane, double t, const double *x, double energy)
{
    double near[WIDTH], energies[2], sums[2] = {0.0, 0.0};
    EACH(i, WIDTH) near[i] = x[i];
    for (int i = 0; i < CONTROLLED; ++i) {
        for (int kind = 0; kind < 2; ++kind) {
            near[i] = x[i] + (kind == 0 ? batch->absolute + batch->relative*fabs(x[i]) : batch->absolute);
            if (energies_of(lane, t, near, energies)) sums[kind] += fabs(energies[0] + energies[1] - energy);
        }
        near[i] = x[i];
    }
    lane->spread = fmax(lane->spread, sums[0]);
    lane->least_spread = fmin(lane->least_spread, sums[1]);
}

static __device__ __noinline__ void look(const Batch *batch, Lane *lane, double t, const double *x)
{
    double energies[2];
    if (!energies_of(lane, t, x, energies)) return;
    const double kinetic = energies[0], potential = energies[1], work = work_of(x);
    lane->moving = fmax(lane->moving, fabs(kinetic));
    lane->moving = fmax(lane->moving, fabs(potential - lane->first_potential));
    lane->moving = fmax(lane->moving, fabs(work));
    lane->largest = fmax(lane->largest, fabs(kinetic) + fabs(potential));
    if (lane->looks % 8 == 0) widen(batch, lane, t, x, kinetic + potential);
    lane->looks += 1;
    lane->off = fmax(lane->off, fabs(kinetic + potential - work - lane->first));
}

static __device__ __noinline__ void begin_balance(const Batch *batch, Lane *lane)
{
    double energies[2];
    lane->first = lane->first_potential = lane->moving = lane->largest = 0.0;
    lane->spread = lane->off = 0.0;
    lane->least_spread = INFINITY;
    lane->looks = 0;
    if (energies_of(lane, lane->t, lane->x, energies)) {
        lane->first = energies[0] + energies[1] - work_of(lane->x);
        lane->first_potential = energies[1];
    }
    look(batch, lane, lane->t, lane->x);
}

/* Whether the balance may have been off by more than the errors of the steps explain: the host decides. */
static __device__ __noinline__ int is_unbalanced(const Batch *batch, Lane *lane, double t, const double *x)
{
    double energies[2];
    look(batch, lane, t, x);
    if (!energies_of(lane, t, x, energies)) return 0;
    widen(batch, lane, t, x, energies[0] + energies[1]);
    const double by_work = WIDTH > CONTROLLED ? batch->absolute : 0.0;
    const double each = fmax(fmax(lane->spread, by_work), batch->relative*lane->moving);
    const double most = fmax(0.01, 200.0*batch->relative)*lane->moving + 10.0*(lane->least_spread + by_work);
    const double explained = fmin(10.0*(1.0 + lane->errors)*each, most) + 1e-11*lane->largest;
    return lane->off > explained;
}
#endif

/* --- constraints: projection.rs, branch.rs, near_singular.rs --------------------------------------------------------- */

#if SPEEDS
/* Add a change, and return its size relative to the changed vector; NaN if an entry is NaN. */
static __device__ double apply(int n, const double *change, double *x)
{
    double size = 0.0, scale = 1.0;
    EACH(i, n) {
        x[i] += change[i];
        size = isnan(change[i]) ? change[i] : isnan(size) ? size : fmax(size, fabs(change[i]));
        scale = fmax(scale, fabs(x[i]));
    }
    return size/scale;
}

/* Project a state onto the constraints; return whether that changes the speeds by no more than the bound. */
static __device__ __noinline__ int project(Lane *lane, double t, double *x, double bound)
{
    double change[WIDTH], size = 0.0;
    for (int turn = 0; turn < 8; ++turn) {
        position_correction_at(t, x, lane->c, change, &lane->deficient);
        size = apply(COORDINATES, change, x);
        if (size <= 1e-9 || isnan(size)) break;
    }
    if (!(size <= 1e-6)) return 0;
    velocity_correction_at(t, x, lane->c, change, &lane->deficient);
    size = apply(SPEEDS, change, x + COORDINATES);
    return !isnan(size) && largest_of(SPEEDS, change) <= bound;
}

/* The largest change of a speed that a correction may make after a step from one state to another. */
static __device__ double branch_bound(const Batch *batch, Lane *lane)
{
    const double here = fmax(
        largest_of(SPEEDS, lane->before + COORDINATES), largest_of(SPEEDS, lane->after + COORDINATES));
    lane->fastest = fmax(lane->fastest, here);
    const double least = 30.0*(batch->absolute + batch->relative*lane->fastest);
    return fmax(least, sqrt(fmax(0.01*batch->relative, 6e-13))*here);
}

/* Take away the part of a small change of the state that leads off the constraints. */
static __device__ __noinline__ void keep_along(Lane *lane, double t, const double *x, double *change)
{
    double at[WIDTH], with[SPEEDS], without[SPEEDS];
    EACH(i, WIDTH) at[i] = x[i];
    EACH(i, SPEEDS) at[COORDINATES + i] = 0.0;
    velocity_correction_at(t, at, lane->c, without, &lane->deficient);
    for (int part = COORDINATES == SPEEDS ? 0 : 1; part < 2; ++part) {
        double *entries = change + part*COORDINATES;
        EACH(i, SPEEDS) at[COORDINATES + i] = entries[i];
        velocity_correction_at(t, at, lane->c, with, &lane->deficient);
        EACH(i, SPEEDS) entries[i] += with[i] - without[i];
    }
}

/* By how much rounding errors change the speeds that the constraints allow. */
static __device__ __noinline__ double noise(Lane *lane)
{
    double near[WIDTH], here[SPEEDS], beside[SPEEDS], change = 0.0;
    velocity_correction_at(lane->t, lane->x, lane->c, here, &lane->deficient);
    EACH(i, WIDTH) near[i] = lane->x[i];
    EACH(i, COORDINATES) near[i] += (i % 2 == 0 ? 1e-7 : -0.5*1e-7)*lane->sizes[i];
    velocity_correction_at(lane->t, near, lane->c, beside, &lane->deficient);
    EACH(i, SPEEDS) change = fmax(change, fabs(here[i] - beside[i]));
    const double speed = fmax(DBL_MIN, largest_of(SPEEDS, lane->x + COORDINATES));
    return DBL_EPSILON*(change/1e-7)*(change/1e-7/speed);
}

static __device__ double noise_bound(const Batch *batch, const Lane *lane)
{
    return batch->absolute + batch->relative*largest_of(SPEEDS, lane->sizes + COORDINATES);
}

/* Whether a step can start at the state, whose rates are known: no singular position is near. */
static __device__ __noinline__ int starts_well(const Batch *batch, Lane *lane, double steepness)
{
    const double now = largest_of(SPEEDS, lane->x + COORDINATES), ever = largest_of(SPEEDS, lane->sizes + COORDINATES);
    double change[WIDTH];
    if (now < 0.01*ever && noise(lane) > 1e-6*now) return 0;
    if (lane->step > 2.0*batch->max_step && noise(lane) > 0.01*noise_bound(batch, lane)) return 0;
    if (steepness <= 30.0) return 1;
    EACH(i, WIDTH) change[i] = lane->k[0][i] - lane->k[STAGES - 1][i];
    const double size = weighted(batch, lane, change);
    keep_along(lane, lane->t, lane->x, change);
    return size*lane->last_h <= 1.0 || weighted(batch, lane, change) > 0.01*size;
}

/* Whether the dense output of the last step satisfies the equations in its middle. */
static __device__ __noinline__ int reads_well(const Batch *batch, Lane *lane, double dense[TERMS][WIDTH])
{
    const double h = lane->last_h, middle = lane->last_t + 0.5*h;
    double y[WIDTH], defect[WIDTH];
    EACH(i, WIDTH) {
        double sum = 0.0;
        for (int term = TERMS - 1; term >= 0; --term) sum = (sum + dense[term][i])*0.5;
        y[i] = lane->before[i] + sum;
    }
    if (!project(lane, middle, y, INFINITY)) return 0;
    evaluate(lane, middle, y, defect);
    EACH(i, WIDTH) {
        double sum = 0.0, slope = 0.0;
        for (int term = TERMS - 1; term >= 0; --term) {
            slope = slope*0.5 + (term % 2 == 0 ? 1.0 : -1.0)*(sum + dense[term][i]);
            sum = (sum + dense[term][i])*0.5;
        }
        defect[i] -= slope/h;
    }
    const double size = h*weighted(batch, lane, defect);
    if (size <= 3.0) return 1;
    keep_along(lane, middle, y, defect);
    const double along = h*weighted(batch, lane, defect);
    return along <= (size > 2.0*along ? 3.0 : 30.0);
}
#endif

/* The rates at a stage of the dense output, on the constraints; not finite where they can't be satisfied. */
static __device__ void evaluate_dense(Lane *lane, double t, double *x, double *out)
{
#if SPEEDS
    if (!project(lane, t, x, INFINITY)) x[0] = NAN;
#endif
    evaluate(lane, t, x, out);
}

/* --- the dense output: dense.rs -------------------------------------------------------------------------------------- */

static __device__ void prepare_dense(Lane *lane, double dense[TERMS][WIDTH])
{
    const double h = lane->last_h;
    add_stages(lane);
    EACH(i, WIDTH) {
        const double start = h*lane->k[0][i], end = h*lane->k[STAGES][i], change = lane->after[i] - lane->before[i];
        dense[0][i] = change;
        dense[1][i] = start - change;
        dense[2][i] = 2.0*change - start - end;
    }
    add_terms(lane, h, dense);
}

/* The dense output of the last step, computed when it is first asked for. */
struct Dense {
    int is_there, is_well;
    double terms[TERMS][WIDTH], bound;
};

static __device__ __noinline__ void ask(const Batch *batch, Lane *lane, Dense *dense)
{
    if (dense->is_there) return;
    prepare_dense(lane, dense->terms);
    dense->is_there = 1;
#if SPEEDS
    for (int row = STAGES; row < ROWS; ++row) dense->is_well &= are_finite(WIDTH, lane->k[row]);
    if (ROWS > STAGES + 1 && dense->is_well) dense->is_well = reads_well(batch, lane, dense->terms);
#endif
}

/* Write the state at an instant of the last step, on the constraints. */
static __device__ __noinline__ void read(const Batch *batch, Lane *lane, Dense *dense, double t, double *out)
{
    const int is_end = t >= lane->t || t >= lane->last_t + lane->last_h;
    double y[WIDTH];
    if (!is_end) ask(batch, lane, dense);
    const double x = (t - lane->last_t)/lane->last_h;
    EACH(i, WIDTH) {
        double sum = 0.0;
        if (!is_end)
            for (int term = TERMS - 1; term >= 0; --term)
                sum = (sum + dense->terms[term][i])*(term % 2 == 0 ? x : 1.0 - x);
        y[i] = is_end ? lane->after[i] : lane->before[i] + sum;
    }
#if SPEEDS
    dense->is_well &= project(lane, t, y, dense->bound);
#endif
    EACH(i, WIDTH) out[i] = y[i];
}

/* --- events: event.rs ------------------------------------------------------------------------------------------------ */

#if EVENTS
/* An instant and the value of an event there. */
struct Point {
    double t, value;
};

static __device__ int crosses(double before, double after, int direction)
{
    const int rises = before < 0.0 && after >= 0.0, falls = before > 0.0 && after <= 0.0;
    return (rises && direction >= 0) || (falls && direction <= 0);
}

/* The next point of a bracket, as a fraction of the way from the newest to the one beyond the zero. */
static __device__ double fraction(double x1, double f1, double x2, double f2, double x3, double f3)
{
    const double xi = (x1 - x2)/(x3 - x2), phi = (f1 - f2)/(f3 - f2);
    if (!(phi*phi < xi && (1.0 - phi)*(1.0 - phi) < 1.0 - xi)) return 0.5;
    return f1/(f2 - f1)*(f3/(f2 - f3)) + (x3 - x1)/(x2 - x1)*(f1/(f3 - f1))*(f2/(f3 - f2));
}

/* Return the value of an event at an instant of the last step, and store the state there in x. */
static __device__ __noinline__ double event_value(
    const Batch *batch, Lane *lane, Dense *dense, int event, double t, double *x)
{
    double values[EVENTS];
    read(batch, lane, dense, t, x);
    events_at(t, x, lane->c, values, &lane->deficient);
    return values[event];
}

/* Find the zero of an event between two points by Chandrupatla's method, and store the state there in x. */
static __device__ __noinline__ double locate(
    const Batch *batch, Lane *lane, Dense *dense, int event, Point before, Point after, double *x)
{
    double x1 = after.t, f1 = after.value, x2 = before.t, f2 = before.value, x3 = x2, f3 = f2, part = 0.5;
    for (int turn = 0; turn < 100; ++turn) {
        const double least = 2.0*DBL_EPSILON*fmax(fabs(x1), fabs(x2))/fabs(x2 - x1);
        if (f1 == 0.0 || !(least <= 0.5)) break;
        const double t = x1 + fmin(fmax(part, least), 1.0 - least)*(x2 - x1);
        const double value = event_value(batch, lane, dense, event, t, x);
        if ((value > 0.0) == (f1 > 0.0)) x3 = x1, f3 = f1;
        else x3 = x2, f3 = f2, x2 = x1, f2 = f1;
        x1 = t, f1 = value;
        part = fraction(x1, f1, x2, f2, x3, f3);
    }
    const double zero = f1 == 0.0 ? x1 : fmax(x1, x2);
    read(batch, lane, dense, zero, x);
    return zero;
}

/* Whether a function may pass zero near the one of three equidistant points at which it has the value `here`. */
static __device__ int may_pass(double a, double b, double c, double here, double noise)
{
    const double below = fmin(fmin(a, b), c), above = fmax(fmax(a, b), c);
    const double bend = 0.5*(fabs(a) - 2.0*fabs(b) + fabs(c)), least = fmin(fmin(fabs(a), fabs(b)), fabs(c));
    return (below >= 0.0 || above <= 0.0) && fabs(here) <= least && fabs(here) + noise < bend;
}

/* Find a point near the point `nearest` of three at which an event is beyond zero by more than the noise. */
static __device__ __noinline__ int find_point_beyond(
    const Batch *batch, Lane *lane, Dense *dense, int event, const Point *three, int nearest, double noise, Point *found)
{
    const double sign = three[0].value + three[1].value + three[2].value < 0.0 ? -1.0 : 1.0;
    Point before = three[nearest == 2 ? 1 : 0], lowest = three[1], after = three[nearest == 0 ? 1 : 2];
    double x[WIDTH];
    if (nearest == 0) lowest.t = before.t + 1e-4*(after.t - before.t);
    if (nearest == 2) lowest.t = after.t - 1e-4*(after.t - before.t);
    if (nearest != 1) lowest.value = event_value(batch, lane, dense, event, lowest.t, x);
    before.value = sign*before.value + noise;
    lowest.value = sign*lowest.value + noise;
    after.value = sign*after.value + noise;
    for (int turn = 0; turn < 60; ++turn) {
        if (lowest.value < 0.0) {
            found->t = lowest.t, found->value = sign*(lowest.value - noise);
            return 1;
        }
        const double left = lowest.t - before.t, right = after.t - lowest.t, longer = fmax(left, right);
        const double fall = (before.value - lowest.value)/left, rise = (after.value - lowest.value)/right;
        const double curvature = (fall + rise)/(left + right), to_vertex = 0.5*(fall/curvature - left);
        if (!(fall >= 0.0 && rise >= 0.0 && lowest.value < curvature*longer*longer)) return 0;
        const int is_far = !(fabs(to_vertex) < 0.1*longer);
        Point next;
        next.t = lowest.t + (is_far ? to_vertex : left > right ? -(0.1*longer) : 0.1*longer);
        next.value = sign*event_value(batch, lane, dense, event, next.t, x) + noise;
        const int is_before = next.t < lowest.t, is_lower = next.value < lowest.value;
        if (is_before == is_lower) after = is_lower ? lowest : next;
        else before = is_lower ? lowest : next;
        if (is_lower) lowest = next;
    }
    return 0;
}

static __device__ int comes_before(const double *one, const double *other)
{
    const int is_terminal = EVENT_IS_TERMINAL[(int)one[0]], is_other = EVENT_IS_TERMINAL[(int)other[0]];
    if (one[1] != other[1]) return one[1] < other[1];
    return is_terminal != is_other ? is_terminal < is_other : one[0] < other[0];
}

/* Store an event among those of its step, in order of time; at one instant, those that end the motion come last. */
static __device__ __noinline__ void store_event(double *rows, long long first, long long count, int event, double t, const double *x)
{
    double row[2 + WIDTH];
    row[0] = event, row[1] = t;
    EACH(i, WIDTH) row[2 + i] = x[i];
    long long place = count;
    for (; place > first && comes_before(row, rows + (place - 1)*(2 + WIDTH)); --place)
        EACH(i, 2 + WIDTH) rows[place*(2 + WIDTH) + i] = rows[(place - 1)*(2 + WIDTH) + i];
    EACH(i, 2 + WIDTH) rows[place*(2 + WIDTH) + i] = row[i];
}

/* Store the zero of an event between two points, if it passes there in its direction; return 0 if there is no room. */
static __device__ int note_crossing(
    const Batch *batch, Lane *lane, Dense *dense, int event, Point before, Point after, long long first)
{
    double *rows = batch->events + lane->number*batch->most_events*(2 + WIDTH), x[WIDTH];
    if (!crosses(before.value, after.value, EVENT_DIRECTION[event])) return 1;
    if (lane->happened == batch->most_events) return 0;
    const double zero = locate(batch, lane, dense, event, before, after, x);
    store_event(rows, first, lane->happened, event, zero, x);
    lane->happened += 1;
    return 1;
}

/* Store the zeros of an event in a step: in excursions, and between neighbouring points of different signs. */
static __device__ __noinline__ int note_events(
    const Batch *batch, Lane *lane, Dense *dense, int event, const Point *points, long long first)
{
    double most = 0.0;
    for (int place = 0; place <= PARTS; ++place) most = fmax(most, fabs(points[place].value));
    const double noise = batch->absolute + batch->relative*most;
    for (int place = 0; place <= PARTS; ++place) {
        const int middle = place == 0 ? 1 : place == PARTS ? PARTS - 1 : place;
        const Point *three = points + middle - 1;
        Point inside;
        if (place > 0 && points[place].value == 0.0) continue;
        if (!may_pass(three[0].value, three[1].value, three[2].value, points[place].value, noise)) continue;
        if (!find_point_beyond(batch, lane, dense, event, three, place - middle + 1, noise, &inside)) continue;
        const Point before = points[place == 0 ? 0 : place - 1], after = points[place == PARTS ? PARTS : place + 1];
        if (!note_crossing(batch, lane, dense, event, before, inside, first)) return 0;
        if (!note_crossing(batch, lane, dense, event, inside, after, first)) return 0;
    }
    for (int part = 1; part <= PARTS; ++part)
        if (!note_crossing(batch, lane, dense, event, points[part - 1], points[part], first)) return 0;
    return 1;
}

/* Find the events of the last step. Return RUNNING, ENDED_BY_EVENT with the row of the last one, or CROWDED. */
static __device__ __noinline__ int find_events(const Batch *batch, Lane *lane, Dense *dense, const double **last)
{
    const double *rows = batch->events + lane->number*batch->most_events*(2 + WIDTH);
    const double start = lane->seen, end = lane->t;
    const long long first = lane->happened;
    double values[EVENTS], x[WIDTH];
    Point points[EVENTS][PARTS + 1];
    EACH(event, EVENTS) points[event][0].t = start, points[event][0].value = lane->values[event];
    for (int part = 1; part <= PARTS; ++part) {
        const double t = part == PARTS ? end : start + (end - start)*(double)part/(double)PARTS;
        read(batch, lane, dense, t, x);
        events_at(t, x, lane->c, values, &lane->deficient);
        EACH(event, EVENTS) points[event][part].t = t, points[event][part].value = values[event];
    }
    for (int event = 0; event < EVENTS; ++event)
        if (!note_events(batch, lane, dense, event, points[event], first)) return CROWDED;
    EACH(event, EVENTS) lane->values[event] = values[event];
    lane->seen = end;
    for (long long place = first; place < lane->happened; ++place) {
        *last = rows + place*(2 + WIDTH);
        if (EVENT_IS_TERMINAL[(int)(*last)[0]]) {
            lane->happened = place + 1;
            return ENDED_BY_EVENT;
        }
    }
    return RUNNING;
}
#endif

/* --- the loop: integrate.rs, runge_kutta/mod.rs ---------------------------------------------------------------------- */

/* Whether accelerations are so large at the start that they may have a pole there. */
static __device__ int may_be_a_pole(const Lane *lane)
{
    return largest_of(ACCELERATIONS, lane->k[0] + FIRST_ACCELERATION)
        > 1e6*fmax(1.0, largest_of(FIRST_ACCELERATION, lane->k[0]));
}

static __device__ __noinline__ void begin(const Batch *batch, Lane *lane, long long number)
{
    lane->number = number;
    lane->reached = 1;
    lane->steps = lane->rejected = lane->evaluations = lane->happened = lane->stiff = 0;
    lane->deficient = lane->stiff_steps = lane->was_rejected = 0;
    lane->is_finite = lane->begins = 1;
    lane->last_error = log(LEAST_ERROR);
    lane->errors = lane->fastest = 0.0;
    lane->t = lane->checked = lane->last_t = lane->seen = batch->t[0];
    lane->last_h = 0.0;
    prepare_at(batch->parameters + number*PARAMETERS, lane->c, &lane->deficient);
    double *out = batch->states + number*batch->instants*WIDTH;
    EACH(i, WIDTH) {
        const double x = batch->starts[number*WIDTH + i];
        out[i] = lane->x[i] = lane->before[i] = lane->after[i] = lane->origin[i] = x;
        lane->sizes[i] = fabs(x);
        lane->last_stage[i] = 0.0;
    }
    lane->step = first_step(batch, lane, batch->t[batch->instants - 1]);
#if ENERGIES
    begin_balance(batch, lane);
#endif
#if EVENTS
    events_at(lane->t, lane->x, lane->c, lane->values, &lane->deficient);
#endif
}

/* Write how a motion ended, and leave the lane free. */
static __device__ __noinline__ void finish(const Batch *batch, Lane *lane, int status, double t, const double *x)
{
#if ENERGIES
    if (status <= ENDED_BY_EVENT && is_unbalanced(batch, lane, t, x)) status = UNBALANCED;
#endif
    if (lane->deficient) status = DEFICIENT;
    long long *counts = batch->counts + lane->number*COUNTS;
    counts[STATUS] = status;
    counts[REACHED] = lane->reached;
    counts[STEPS] = lane->steps;
    counts[REJECTED] = lane->rejected;
    counts[EVALUATIONS] = lane->evaluations;
    counts[STIFF] = lane->stiff;
    counts[HAPPENED] = lane->happened;
    batch->ends[lane->number] = t;
    lane->number = -1;
    atomicAdd(batch->queue + 1, 1ULL);
}

/* Evaluate the rates at the start of a step, and check them. */
static __device__ int begin_step(const Batch *batch, Lane *lane)
{
    lane->is_finite = 1;
    if (lane->begins) {
        if (may_be_a_pole(lane)) return AT_POLE;
    } else if (EVALUATES_END && !SPEEDS) {
        EACH(i, WIDTH) lane->k[0][i] = lane->k[STAGES][i];
    } else {
        evaluate(lane, lane->t, lane->x, lane->k[0]);
    }
    if (!are_finite(WIDTH, lane->k[0])) return NOT_FINITE;
    if (lane->begins) return RUNNING;
    const double rates = squared_distance(WIDTH, lane->k[0], lane->k[STAGES - 1]);
    const double states = squared_distance(WIDTH, lane->x, lane->last_stage);
    const double steepness = states > 0.0 ? lane->last_h*sqrt(rates/states) : 0.0;
#if SPEEDS
    if (!starts_well(batch, lane, steepness)) return SINGULAR;
#endif
    lane->stiff_steps = steepness > STABILITY ? lane->stiff_steps + 1 : lane->stiff_steps > 0 ? lane->stiff_steps - 1 : 0;
    lane->stiff |= lane->stiff_steps >= STIFF_STEPS;
    return RUNNING;
}

/* Shorten a step that was rejected. */
static __device__ int reject(const Batch *batch, Lane *lane, double h, double error)
{
    lane->is_finite = isfinite(error) != 0;
    const double factor = lane->is_finite ? SAFETY*pow(error, -EXPONENT) : 0.1;
    lane->step = h*fmin(fmax(factor, lane->is_finite ? SHRINK : 0.1), 1.0);
    lane->rejected += 1;
#if SPEEDS
    if (lane->was_rejected && !(noise(lane) <= noise_bound(batch, lane))) return SINGULAR;
#endif
    lane->was_rejected = 1;
    return RUNNING;
}

/* Continue at the end of a step, and choose the next one by proportional and integral control. */
static __device__ void accept(Lane *lane, double h, double error, double t, int is_last)
{
    const double now = log(fmax(error, DBL_MIN)), before = lane->last_error;
    lane->last_error = fmax(now, log(LEAST_ERROR));
    const double wanted = SAFETY*exp((0.2*MEMORY - EXPONENT)*now + MEMORY*before);
    const double factor = fmin(fmax(wanted, SHRINK), GROW), next = h*(lane->was_rejected ? fmin(factor, 1.0) : factor);
    lane->errors += error;
    lane->last_t = lane->t;
    lane->last_h = h;
    lane->t = t;
    lane->step = is_last ? fmax(next, lane->step) : next;
    lane->steps += 1;
    lane->was_rejected = lane->begins = 0;
    EACH(i, WIDTH) {
        lane->before[i] = lane->x[i];
        lane->x[i] = lane->after[i];
        lane->sizes[i] = fmax(fmax(lane->sizes[i], fabs(lane->x[i])), fabs(lane->x[i] - lane->origin[i]));
    }
}

/* Write the states at the instants of a step that was accepted, find its events, and put its end onto the constraints. */
static __device__ int end_step(const Batch *batch, Lane *lane)
{
    const long long n = batch->instants;
    double *states = batch->states + lane->number*n*WIDTH;
    Dense dense;
    dense.is_there = 0, dense.is_well = 1, dense.bound = INFINITY;
#if SPEEDS
    dense.bound = branch_bound(batch, lane);
    double landed[WIDTH];
    EACH(i, WIDTH) landed[i] = lane->after[i];
    if (!project(lane, lane->t, landed, dense.bound)) return SINGULAR;
#endif
    long long reached = lane->reached;
    for (; reached < n && batch->t[reached] <= lane->t; ++reached)
        read(batch, lane, &dense, batch->t[reached], states + reached*WIDTH);
#if EVENTS
    const double *last = 0;
#if SPEEDS
    ask(batch, lane, &dense);
#endif
    const int found = find_events(batch, lane, &dense, &last);
    if (!dense.is_well) return SINGULAR;
    if (found == CROWDED) return found;
    if (found == ENDED_BY_EVENT) {
        while (lane->reached < reached && batch->t[lane->reached] <= last[1]) lane->reached += 1;
        finish(batch, lane, ENDED_BY_EVENT, last[1], last + 2);
        return RUNNING;
    }
#endif
    if (!dense.is_well) return SINGULAR;
    lane->reached = reached;
#if SPEEDS
    EACH(i, WIDTH) lane->x[i] = landed[i];
#endif
#if ENERGIES
    if (lane->steps % 4 == 0) look(batch, lane, lane->t, lane->x);
#endif
    if (lane->steps % STALLED_STEPS == 0) {
        if (lane->t - lane->checked < STALLED_PART*(batch->t[n - 1] - batch->t[0])) return STALLED;
        lane->checked = lane->t;
    }
    return lane->t >= batch->t[n - 1] ? COMPLETED : RUNNING;
}

/* Try one step of the motion of a lane. Return RUNNING, or why it ended. */
static __device__ int try_step(const Batch *batch, Lane *lane)
{
    const double end = batch->t[batch->instants - 1];
    if (!lane->was_rejected) {
        const int status = begin_step(batch, lane);
        if (status != RUNNING) return status;
    }
    double h = fmin(lane->step, batch->max_step), errors[ESTIMATES][WIDTH];
    if (h <= 4.0*DBL_EPSILON*fabs(lane->t) || h < DBL_MIN) return lane->is_finite ? COLLAPSED : NOT_FINITE;
    const int is_last = lane->t + 1.01*h >= end;
    if (is_last) h = end - lane->t;
    take_stages(lane, h, errors);
    double error = weighted_error(batch, lane, errors, h);
#if SPEEDS
    if (error > 1.0) {
        for (int estimate = 0; estimate < ESTIMATES; ++estimate)
            keep_along(lane, lane->t + h, lane->after, errors[estimate]);
        const double along = weighted_error(batch, lane, errors, h);
        if (along < 0.01*error) return SINGULAR;
        if (lane->was_rejected) error = fmin(error, along);
    }
#endif
    if (!(error <= 1.0)) return reject(batch, lane, h, error);
    accept(lane, h, error, is_last ? end : lane->t + h, is_last);
    return end_step(batch, lane);
}

/* Try so many steps in each lane; lanes go on where the last call left them. */
extern "C" __global__ void advance(
    Lane *lanes, long long turns, long long cases, long long instants, long long most_events, double relative, double absolute,
    double max_step, const double *t, const double *starts, const double *parameters, double *states, double *ends,
    double *events, long long *counts, unsigned long long *queue)
{
    const Batch batch = {cases, instants, most_events, relative, absolute, max_step, t, starts, parameters, states,
        ends, events, counts, queue};
    const long long place = (long long)blockIdx.x*blockDim.x + threadIdx.x;
    Lane lane = lanes[place];
    for (long long turn = 0; turn < turns; ++turn) {
        if (lane.number < 0) {
            const unsigned long long next = atomicAdd(queue, 1ULL);
            if (next >= (unsigned long long)cases) break;
            begin(&batch, &lane, (long long)next);
        }
        const int status = try_step(&batch, &lane);
        if (status != RUNNING) finish(&batch, &lane, status, lane.t, lane.x);
    }
    lanes[place] = lane;
}

/* Leave all lanes free. */
extern "C" __global__ void clear(Lane *lanes)
{
    lanes[(long long)blockIdx.x*blockDim.x + threadIdx.x].number = -1;
}

/* Write the size of a lane in bytes. */
extern "C" __global__ void measure(long long *size)
{
    *size = (long long)sizeof(Lane);
}
