/* Many motions of one model, each in a thread; made by symbody. */

#ifndef DBL_MIN
#define DBL_MIN 2.2250738585072014e-308
#define DBL_MAX 1.7976931348623157e308
#define DBL_EPSILON 2.220446049250313e-16
#endif
#ifndef INFINITY
#define INFINITY __longlong_as_double(0x7ff0000000000000LL)
#endif
#ifndef NAN
#define NAN __longlong_as_double(0x7ff8000000000000LL)
#endif
#define UNROLL _Pragma("unroll")

/* The sine of an angle up to 1e5, or, of the angle in the next quadrant, its cosine: the arithmetic of the machine
 * code for the host (codegen/llvm/sincos.py). Sine and cosine of one angle share its reduction. */
static __device__ __forceinline__ double wave(double x, long long next)
{
    const double shifted = fma(x, 0.6366197723675814, 6755399441055744.0);
    const double multiple = shifted - 6755399441055744.0;
    const long long quadrant = __double_as_longlong(shifted) + next;
    const double high = fma(multiple, -1.5707963267948966, x), middle = fma(multiple, -6.123233995736766e-17, high);
    const double r = fma(multiple, 1.4973849048591698e-33, middle), z = r*r;
    double s = 1.58969099521155010221e-10, c = -1.13596475577881948265e-11;
    s = fma(fma(s, z, -2.50507602534068634195e-08), z, 2.75573137070700676789e-06);
    s = fma(fma(fma(s, z, -1.98412698298579493134e-04), z, 8.33333333332248946124e-03), z, -1.66666666666666324348e-01);
    c = fma(fma(c, z, 2.08757232129817482790e-09), z, -2.75573143513906633035e-07);
    c = fma(fma(fma(c, z, 2.48015872894767294178e-05), z, -1.38888888888741095749e-03), z, 4.16666666666666019037e-02);
    const double sine = fma(z*r, s, r), cosine = fma(z, fma(z, c, -0.5), 1.0);
    const double value = quadrant & 1 ? cosine : sine;
    return quadrant & 2 ? -value : value;
}

static __device__ __forceinline__ double sine(double x) { return fabs(x) <= 1e5 ? wave(x, 0) : sin(x); }
static __device__ __forceinline__ double cosine(double x) { return fabs(x) <= 1e5 ? wave(x, 1) : cos(x); }
static __device__ __forceinline__ double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }
static __device__ __forceinline__ double least(double a, double b) { return a < b || a != a ? a : b; }
static __device__ __forceinline__ double greatest(double a, double b) { return a > b || a != a ? a : b; }


static __device__ __noinline__ void prepare(const double *__restrict__ p, double *__restrict__ c,
    int *deficient)
{
    const double g  = p[0];
    const double l1 = p[1];
    const double m1 = p[2];

    /* parameters: 1 multiplication, 1 division */
    c[2] = g/l1;
    c[3] = g*m1;

    /* entries that need no computation */
    c[0] = l1;
    c[1] = m1;
    (void)deficient;
}

static __device__ __noinline__ void rates(const double *__restrict__ c, double t,
    const double *__restrict__ x, double *__restrict__ out, int *deficient)
{
    const double theta1     = x[0];
    const double theta1_dot = x[1];
    const double k2         = c[2];  /* g/l1 */

    /* velocities: 1 addition, 1 multiplication, 1 function */
    out[1] = -sine(theta1)*k2;

    /* entries that need no computation */
    out[0] = theta1_dot;
    (void)t;
    (void)deficient;
}

static __device__ __noinline__ void energies(const double *__restrict__ c, double t,
    const double *__restrict__ x, double *__restrict__ out, int *deficient)
{
    const double theta1     = x[0];
    const double theta1_dot = x[1];
    const double l1         = c[0];
    const double m1         = c[1];
    const double k3         = c[3];  /* g*m1 */

    /* velocities: 1 addition, 6 multiplications, 1 function */
    const double v1 = l1*theta1_dot;
    out[0] = 0.5*(m1*(v1*v1));
    out[1] = -l1*cosine(theta1)*k3;
    (void)t;
    (void)deficient;
}

static __device__ __noinline__ void events(const double *__restrict__ c, double t,
    const double *__restrict__ x, double *__restrict__ out, int *deficient)
{
    const double theta1 = x[0];

    /* entries that need no computation */
    out[0] = theta1;
    (void)c;
    (void)t;
    (void)deficient;
}

static __device__ void prepare_at(const double *p, double *c, int *deficient)
{
    prepare(p, c, deficient);
}
static __device__ void rates_at(double t, const double *x, const double *c, double *out, int *deficient)
{
    rates(c, t, x, out, deficient);
}
static __device__ void energies_at(double t, const double *x, const double *c, double *out, int *deficient)
{
    energies(c, t, x, out, deficient);
}
static __device__ void events_at(double t, const double *x, const double *c, double *out, int *deficient)
{
    events(c, t, x, out, deficient);
}

#define WIDTH 2
#define CONTROLLED 2
#define PARAMETERS 3
#define CONSTANTS 4
#define FIRST_ACCELERATION 1
#define ACCELERATIONS 1
#define COORDINATES 0
#define SPEEDS 0
#define ENERGIES 2
#define EVENTS 1
#define ORDER 5
#define STAGES 6
#define ROWS 7
#define EVALUATES_END 1
#define STABILITY 3.25
#define ESTIMATES 1
#define TERMS 4

static __device__ const int EVENT_DIRECTION[] = {1};
static __device__ const int EVENT_IS_TERMINAL[] = {0};

/* Here follows symbody/simulation/device/integrator.cu. */


static __device__ void take_stages(Lane *lane, double h, double errors[ESTIMATES][WIDTH])
{
    double y[WIDTH];
    EACH(i, WIDTH)
        y[i] = lane->x[i] + h*(0.161*lane->k[0][i]);
    evaluate(lane, lane->t + 0.161*h, y, lane->k[1]);
    EACH(i, WIDTH)
        y[i] = lane->x[i] + h*(-0.008480655492356989*lane->k[0][i] + 0.335480655492357*lane->k[1][i]);
    evaluate(lane, lane->t + 0.327*h, y, lane->k[2]);
    EACH(i, WIDTH)
        y[i] = lane->x[i] + h*(2.8971530571054935*lane->k[0][i] - 6.359448489975075*lane->k[1][i] + 4.3622954328695815*lane->k[2][i]);
    evaluate(lane, lane->t + 0.9*h, y, lane->k[3]);
    EACH(i, WIDTH)
        y[i] = lane->x[i] + h*(5.325864828439257*lane->k[0][i] - 11.748883564062828*lane->k[1][i] + 7.4955393428898365*lane->k[2][i]
            - 0.09249506636175525*lane->k[3][i]);
    evaluate(lane, lane->t + 0.9800255409045097*h, y, lane->k[4]);
    EACH(i, WIDTH)
        y[i] = lane->x[i] + h*(5.86145544294642*lane->k[0][i] - 12.92096931784711*lane->k[1][i] + 8.159367898576159*lane->k[2][i]
            - 0.071584973281401*lane->k[3][i] - 0.028269050394068383*lane->k[4][i]);
    evaluate(lane, lane->t + 1.0*h, y, lane->k[5]);
    EACH(i, WIDTH) lane->last_stage[i] = y[i];
    EACH(i, WIDTH)
        lane->after[i] = lane->x[i] + h*(0.09646076681806523*lane->k[0][i] + 0.01*lane->k[1][i] + 0.4798896504144996*lane->k[2][i]
            + 1.379008574103742*lane->k[3][i] - 3.290069515436081*lane->k[4][i] + 2.324710524099774*lane->k[5][i]);
    evaluate(lane, lane->t + h, lane->after, lane->k[6]);
    EACH(i, WIDTH)
        errors[0][i] = -0.001780011052225777*lane->k[0][i] - 0.0008164344596567469*lane->k[1][i] + 0.007880878010261995*lane->k[2][i]
            - 0.1447110071732629*lane->k[3][i] + 0.5823571654525552*lane->k[4][i] - 0.45808210592918697*lane->k[5][i]
            + 0.015151515151515152*lane->k[6][i];
}

static __device__ void add_stages(Lane *lane)
{
    const double t = lane->last_t, h = lane->last_h;
    double y[WIDTH];
    EACH(i, WIDTH) y[i] = lane->after[i];
    evaluate_dense(lane, t + h, y, lane->k[6]);
}

static __device__ void add_terms(const Lane *lane, double h, double dense[TERMS][WIDTH])
{
    EACH(i, WIDTH)
        dense[3][i] = h*(-1.0530884977290216*lane->k[0][i] + 0.1017*lane->k[1][i] + 2.490627285651253*lane->k[2][i]
            - 16.548102889244902*lane->k[3][i] + 47.37952196281928*lane->k[4][i] - 34.87065786149661*lane->k[5][i]
            + 2.5*lane->k[6][i]);
}
