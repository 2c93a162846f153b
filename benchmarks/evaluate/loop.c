/* The loops that are timed: each contender is called by the address of its function, for one state after the other. */
#include <time.h>

/* Time of the processor: other programs take theirs from the clock on the wall, and most of it from long trials. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec*1e9 + t.tv_nsec;
}

/* A function of a row of inputs and a row of outputs; nanoseconds a call. */
double loop_rows(void (*f)(const double *, double *), const double *in, int inputs, double *out, int outputs, int states,
                 int repetitions)
{
    const double start = now();
    for (int r = 0; r < repetitions; r++)
        for (int i = 0; i < states; i++) f(in + (long)i*inputs, out + (long)i*outputs);
    return (now() - start)/((double)repetitions*states);
}

/* A function of columns, many states at a time. */
double loop_columns(void (*f)(const double *const *, double *, long, long, long), const double *const *in, double *out,
                    int states, int repetitions)
{
    const double start = now();
    for (int r = 0; r < repetitions; r++) f(in, out, 0, states, states);
    return (now() - start)/((double)repetitions*states);
}

/* A function of CasADi's: arrays of arguments and of results, and working memory. */
typedef int casadi_function(const double **, double **, long long *, double *, int);

double loop_casadi(casadi_function *f, const double *in, const int *sizes, int arguments, double *out, int outputs,
                   int states, int repetitions, const double **arg, double **res, long long *iw, double *w)
{
    int inputs = 0;
    for (int k = 0; k < arguments; k++) inputs += sizes[k];
    const double start = now();
    for (int r = 0; r < repetitions; r++)
        for (int i = 0; i < states; i++) {
            const double *row = in + (long)i*inputs;
            for (int k = 0; k < arguments; k++) {
                arg[k] = row;
                row += sizes[k];
            }
            res[0] = out + (long)i*outputs;
            f(arg, res, iw, w, 0);
        }
    return (now() - start)/((double)repetitions*states);
}
