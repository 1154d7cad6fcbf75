/* SPDX-License-Identifier: Apache-2.0 */
/**
 * \file
 * patchproof for C, and for whatever calls C. Models with exact numbers, evaluation in batches, knot insertion, elevation and
 * extraction, proofs of how patches join, Gregory fill, certified triangles.
 *
 *     patchproof_context* context = NULL;
 *     patchproof_model* model = NULL;
 *     patchproof_report* report = NULL;
 *     if (patchproof_context_create(0, &context) != PATCHPROOF_OK) return 1;
 *     if (patchproof_model_read_file(context, patchproof_from("part.json"), 0, &model) != PATCHPROOF_OK ||
 *         patchproof_certify(context, model, NULL, NULL, &report) != PATCHPROOF_OK)
 *       puts(patchproof_error_text(context));
 *
 * Conventions, which every function keeps:
 *  - It returns a status. On any but PATCHPROOF_OK the context that was given says what was wrong, and outputs are as they were;
 *    only arrays of results may be partly written. Results must not overlap what is read.
 *  - No exception leaves it, nothing is printed, no signal handler or global state is touched. The floating-point environment of
 *    the caller (rounding, flush-to-zero, exception flags) has no influence, and is given back as it was.
 *  - Handles are opaque and, but for contexts, never change: any number of threads may use one at once. A context serves one call
 *    at a time; use one for each thread. Free a handle when no other call uses it; the order does not matter.
 *  - Arrays come with the length they have; buffers belong to the caller. For results of unknown length pass the buffer and its
 *    length: *needed tells the length it takes, and PATCHPROOF_BUFFER_TOO_SMALL says that there was less (ask with NULL and 0).
 *  - Texts are UTF-8 with their length; texts that come out end in a zero byte as well, and live as long as the handle they
 *    came from.
 *  - Structs that may grow begin with their size, which the caller sets; all other members are 0 for the default. The other
 *    structs stay as they are.
 *  - Parameters are those of the patch's own domain, both ends included; lengths are in the model's units, angles in degrees.
 *    Patches and curves count from 0. Points along v run fastest.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define PATCHPROOF_API __attribute__((visibility("default")))
#else
#define PATCHPROOF_API
#endif
/* clang-format off */
#ifdef __cplusplus
#if __cplusplus >= 201103L
#define PATCHPROOF_NOEXCEPT noexcept
#else
#define PATCHPROOF_NOEXCEPT
#endif
extern "C" {
#else
#define PATCHPROOF_NOEXCEPT
#endif

/** What this header describes. A library of another number does not fit; it is also in the name of the shared library. */
#define PATCHPROOF_ABI_VERSION 0u

typedef int32_t patchproof_status;
enum {
  PATCHPROOF_OK = 0,
  PATCHPROOF_BAD_DATA = 1,         /**< numbers, a file or a request that cannot be used; the error has place and values */
  PATCHPROOF_BAD_ARGUMENT = 2,     /**< NULL, a wrong length, no value of an enum, an index out of range */
  PATCHPROOF_BUFFER_TOO_SMALL = 3, /**< *needed says how long it has to be */
  PATCHPROOF_FREED_HANDLE = 4,     /**< seen for certain under PATCHPROOF_KEEP_FREED_HANDLES only */
  PATCHPROOF_CONTEXT_BUSY = 5,     /**< another call, perhaps the one whose callback this is, uses the context */
  PATCHPROOF_STOPPED = 6,          /**< the callback asked for it */
  PATCHPROOF_CALLBACK_THREW = 7,   /**< a C++ exception came out of the callback */
  PATCHPROOF_OUT_OF_MEMORY = 8,    /**< or of threads; docs/library.md names what cannot be promised */
  PATCHPROOF_INTERNAL_ERROR = 9    /**< our fault: please report it */
};

/** Bytes, not ended by a zero. {NULL, 0} is the empty text. */
typedef struct {
  const char* data;
  size_t length;
} patchproof_text;

/* ---- Library and context --------------------------------------------------------------------------------------- */

typedef struct patchproof_context patchproof_context;

PATCHPROOF_API uint32_t patchproof_abi_version(void) PATCHPROOF_NOEXCEPT;
/** "0.1.0" */
PATCHPROOF_API const char* patchproof_version(void) PATCHPROOF_NOEXCEPT;
/** "PATCHPROOF_OK"; of any other number "unknown status". */
PATCHPROOF_API const char* patchproof_status_name(patchproof_status status) PATCHPROOF_NOEXCEPT;
/** The text that ends before the first zero byte, NULL being the empty one. */
PATCHPROOF_API patchproof_text patchproof_from(const char* text) PATCHPROOF_NOEXCEPT;

enum {
  /** For debugging: the context, and handles made with it, keep some bytes when they are freed, so that a later use or a
   *  second free is answered with PATCHPROOF_FREED_HANDLE. Without it that is undefined, as with free(). */
  PATCHPROOF_KEEP_FREED_HANDLES = 1
};
PATCHPROOF_API patchproof_status patchproof_context_create(
    uint32_t flags, patchproof_context** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_context_free(patchproof_context* context) PATCHPROOF_NOEXCEPT;

/** The texts are those of the last call with this context, and live until the next one. Threads that share a context may find
 *  the error of another's call here: have one for each thread. */
typedef struct {
  size_t struct_size;
  patchproof_status status;
  patchproof_text code;    /**< of PATCHPROOF_BAD_DATA, e.g. "wrong_count"; error.h lists all */
  patchproof_text where;   /**< "part.json at /patches/3/knots/0" */
  patchproof_text message; /**< one sentence */
  patchproof_text values;  /**< the offending values, as read */
} patchproof_error;
PATCHPROOF_API patchproof_status patchproof_last_error(
    const patchproof_context* context, patchproof_error* out) PATCHPROOF_NOEXCEPT;
/** All of it in one line, "" after PATCHPROOF_OK. Never NULL. */
PATCHPROOF_API const char* patchproof_error_text(const patchproof_context* context) PATCHPROOF_NOEXCEPT;

/** Called on the thread that made the call, some twenty times a second, and at last with done = all when that is reached.
 *  `all` is 0 while it is not known. Anything but 0 stops the work. The callback must not use the call's context,
 *  and has to return (no longjmp, no end of the thread). It runs with the default rounding mode. */
typedef struct {
  void* user;
  int32_t (*progress)(void* user, uint64_t done, uint64_t all);
} patchproof_callback;

/* ---- Models: exact numbers, from files, texts and arrays ------------------------------------------------------- */

typedef struct patchproof_model patchproof_model;

/** Decimals in files: as they stand, or as the nearest doubles. */
enum { PATCHPROOF_DECIMALS_EXACT = 0, PATCHPROOF_DECIMALS_BINARY64 = 1 };

/** Every text format of docs/formats.md; not STEP, IGES, BREP, which the program reads. */
PATCHPROOF_API patchproof_status patchproof_model_read_file(
    patchproof_context* context, patchproof_text path, int32_t decimals, patchproof_model** out) PATCHPROOF_NOEXCEPT;
/** The bytes of such a file; `name` stands in errors, and its extension helps to know the format. */
PATCHPROOF_API patchproof_status patchproof_model_read_text(patchproof_context* context, patchproof_text bytes,
    patchproof_text name, int32_t decimals, patchproof_model** out) PATCHPROOF_NOEXCEPT;

/** A B-spline surface in doubles, each taken as exactly the number it is. A Bézier patch has knots 0 … 0 1 … 1. */
typedef struct {
  size_t struct_size;
  int32_t degree_u, degree_v;
  const double* knots_u;
  size_t knots_u_length; /**< number of points along u + degree_u + 1; likewise along v */
  const double* knots_v;
  size_t knots_v_length;
  const double* points; /**< x y z of each control point */
  size_t points_length; /**< numbers: 3 · points along u · points along v */
  const double* weights;
  size_t weights_length; /**< one for each point, or 0: all are 1 */
  patchproof_text name;
} patchproof_surface_data;

typedef struct {
  size_t struct_size;
  int32_t degree;
  const double* knots;
  size_t knots_length;
  const double* points;
  size_t points_length;
  const double* weights;
  size_t weights_length;
  patchproof_text name;
} patchproof_curve_data;

enum { PATCHPROOF_EDGE_U_MIN = 0, PATCHPROOF_EDGE_U_MAX = 1, PATCHPROOF_EDGE_V_MIN = 2, PATCHPROOF_EDGE_V_MAX = 3 };
/** Whole edges that belong together; reversed: their parameters run against each other. */
typedef struct {
  int32_t patch_a, edge_a, patch_b, edge_b, reversed;
} patchproof_declared_join;

typedef struct {
  size_t struct_size;
  const patchproof_surface_data* patches;
  size_t patches_length;
  const patchproof_curve_data* curves;
  size_t curves_length;
  const patchproof_declared_join* joins; /**< none: joins are found from the geometry */
  size_t joins_length;
  patchproof_text units; /**< "mm" */
} patchproof_model_data;
/** Weights as in files: any but those under which the denominator vanishes; 0 and negative ones as well. */
PATCHPROOF_API patchproof_status patchproof_model_create(
    patchproof_context* context, const patchproof_model_data* data, patchproof_model** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_free(patchproof_model* model) PATCHPROOF_NOEXCEPT;

/** Patches are numbered in the order B-splines, GERBS, Gregory patches; curves B-splines, GERBS. */
typedef struct {
  size_t struct_size;
  size_t patches, gerbs_patches, gregory_patches; /**< patches: all of them */
  size_t curves, gerbs_curves, solids;
  patchproof_text format, units;
  patchproof_text notes; /**< what the reader noticed, one to a line */
} patchproof_model_info;
PATCHPROOF_API patchproof_status patchproof_model_get_info(
    patchproof_context* context, const patchproof_model* model, patchproof_model_info* out) PATCHPROOF_NOEXCEPT;

enum { PATCHPROOF_KIND_BSPLINE = 0, PATCHPROOF_KIND_GERBS = 1, PATCHPROOF_KIND_GREGORY = 2 };
/** Of a patch, or of a curve, which has zeros for v. Of GERBS and Gregory patches only kind, domain and name. */
typedef struct {
  size_t struct_size;
  int32_t kind, degree_u, degree_v, is_rational;
  int32_t is_double; /**< all numbers are doubles: patchproof_model_patch_get_data loses nothing */
  size_t points_u, points_v, knots_u, knots_v;
  double domain[4]; /**< u from, to, v from, to: the nearest doubles */
  patchproof_text name;
} patchproof_spline_info;
PATCHPROOF_API patchproof_status patchproof_model_patch_get_info(patchproof_context* context,
    const patchproof_model* model, size_t patch, patchproof_spline_info* out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_get_info(patchproof_context* context,
    const patchproof_model* model, size_t curve, patchproof_spline_info* out) PATCHPROOF_NOEXCEPT;

/** Where the nearest doubles go; NULL: not wanted. Lengths are those of patchproof_spline_info (3 numbers to a point). */
typedef struct {
  size_t struct_size;
  double *knots_u, *knots_v, *points, *weights;
  size_t knots_u_length, knots_v_length, points_length, weights_length;
} patchproof_spline_buffers;
PATCHPROOF_API patchproof_status patchproof_model_patch_get_data(patchproof_context* context,
    const patchproof_model* model, size_t patch, const patchproof_spline_buffers* out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_get_data(patchproof_context* context,
    const patchproof_model* model, size_t curve, const patchproof_spline_buffers* out) PATCHPROOF_NOEXCEPT;

enum { PATCHPROOF_FORMAT_JSON = 0, PATCHPROOF_FORMAT_G2 = 1 };
/** JSON keeps every number exactly; .g2 rounds to doubles, and models with Gregory patches are refused for it.
 *  *needed counts the zero byte at the end. */
PATCHPROOF_API patchproof_status patchproof_model_write(patchproof_context* context, const patchproof_model* model,
    int32_t format, char* buffer, size_t length, size_t* needed) PATCHPROOF_NOEXCEPT;

/* ---- Refinement: exact. The same surface under other knots, in a new model ------- */

enum { PATCHPROOF_DIRECTION_U = 0, PATCHPROOF_DIRECTION_V = 1 };
/** The model with its B-spline patch on finer knots; each text ("1/3", "0.25") is one knot, inserted once. */
PATCHPROOF_API patchproof_status patchproof_model_patch_insert_knots(patchproof_context* context,
    const patchproof_model* model, size_t patch, int32_t direction, const patchproof_text* knots, size_t length,
    patchproof_model** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_insert_knots(patchproof_context* context,
    const patchproof_model* model, size_t curve, const patchproof_text* knots, size_t length,
    patchproof_model** out) PATCHPROOF_NOEXCEPT;
/** The model with the degree of the patch raised by `times`. */
PATCHPROOF_API patchproof_status patchproof_model_patch_elevate(patchproof_context* context,
    const patchproof_model* model, size_t patch, int32_t direction, int32_t times,
    patchproof_model** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_elevate(patchproof_context* context,
    const patchproof_model* model, size_t curve, int32_t times, patchproof_model** out) PATCHPROOF_NOEXCEPT;
/** A model of the patch's (the curve's) Bézier pieces, those along v running fastest, over their own parts of the domain. */
PATCHPROOF_API patchproof_status patchproof_model_patch_extract_bezier(patchproof_context* context,
    const patchproof_model* model, size_t patch, patchproof_model** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_extract_bezier(patchproof_context* context,
    const patchproof_model* model, size_t curve, patchproof_model** out) PATCHPROOF_NOEXCEPT;

/* ---- Evaluation in batches ------------------------------------------------------------------------------------- */

typedef struct patchproof_surface patchproof_surface;
typedef struct patchproof_curve patchproof_curve;

/** Prepared for doubles. Numbers of the model are rounded to the nearest doubles first (see is_double of its info). */
PATCHPROOF_API patchproof_status patchproof_surface_of(patchproof_context* context, const patchproof_model* model,
    size_t patch, patchproof_surface** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_surface_create(
    patchproof_context* context, const patchproof_surface_data* data, patchproof_surface** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_surface_free(patchproof_surface* surface) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_curve_of(patchproof_context* context, const patchproof_model* model,
    size_t curve, patchproof_curve** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_curve_create(
    patchproof_context* context, const patchproof_curve_data* data, patchproof_curve** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_curve_free(patchproof_curve* curve) PATCHPROOF_NOEXCEPT;

/** Item i is at u[i·stride], v[i·stride]. Pairs u v u v …: {uv, uv + 1, count, 2}. Of curves: v is NULL. */
typedef struct {
  const double *u, *v;
  size_t count;
  ptrdiff_t stride; /**< 0 stands for 1; lengths are (count − 1)·stride + 1 and more */
} patchproof_parameters;

/** Vector i goes to x[i·stride], y[i·stride], z[i·stride]. x y z x y z …: {p, p + 1, p + 2, count, 3}.
 *  x NULL: not wanted. */
typedef struct {
  double *x, *y, *z;
  size_t count; /**< as many as parameters */
  ptrdiff_t stride;
} patchproof_vectors;

enum { PATCHPROOF_SIDE_RIGHT = 0, PATCHPROOF_SIDE_LEFT = 1 };
typedef struct {
  size_t struct_size;
  int32_t side_u, side_v; /**< which limit counts at a knot */
  int32_t threads;        /**< 0 and 1: the caller's; −1: one for each processor */
} patchproof_evaluate_options;

/** Of curves: point, du, duu. normal: (S_u × S_v) / |S_u × S_v|, and 0 0 0 where the computed product is 0
 *  or far below its size elsewhere (where the exact one is 0, rounding errors may still have a direction). */
typedef struct {
  size_t struct_size;
  patchproof_vectors point, du, dv, normal, duu, duv, dvv;
  size_t undefined_normals; /**< set by the call */
} patchproof_derivatives;
/** Points and derivatives in double, each within patchproof_surface_error_bound of the exact value at these doubles (so an edge
 *  that two patches share may differ in its last digits; patchproof_surface_evaluate_rounded gives the same there).
 *  ERRORS PATCHPROOF_BAD_DATA, outside_domain (NaN is) or vanishing_weight, naming the first item. */
PATCHPROOF_API patchproof_status patchproof_surface_evaluate(patchproof_context* context,
    const patchproof_surface* surface, patchproof_parameters at, const patchproof_evaluate_options* options,
    patchproof_derivatives* out) PATCHPROOF_NOEXCEPT;
/** On a grid: item i · v_length + j is at (u[i], v[j]). */
PATCHPROOF_API patchproof_status patchproof_surface_evaluate_grid(patchproof_context* context,
    const patchproof_surface* surface, const double* u, size_t u_length, const double* v, size_t v_length,
    const patchproof_evaluate_options* options, patchproof_derivatives* out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_curve_evaluate(patchproof_context* context, const patchproof_curve* curve,
    patchproof_parameters at, const patchproof_evaluate_options* options,
    patchproof_derivatives* out) PATCHPROOF_NOEXCEPT;
enum {
  PATCHPROOF_VECTOR_POINT = 0,
  PATCHPROOF_VECTOR_DU = 1,
  PATCHPROOF_VECTOR_DV = 2,
  PATCHPROOF_VECTOR_DUU = 3,
  PATCHPROOF_VECTOR_DUV = 4,
  PATCHPROOF_VECTOR_DVV = 5
};
/** |computed − exact| of each coordinate, everywhere; +infinity where nothing is known. Of curves: POINT, DU, DUU. */
PATCHPROOF_API patchproof_status patchproof_surface_error_bound(
    patchproof_context* context, const patchproof_surface* surface, int32_t vector, double* out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_curve_error_bound(
    patchproof_context* context, const patchproof_curve* curve, int32_t vector, double* out) PATCHPROOF_NOEXCEPT;
/** Points, and for each a bound of its own: |computed − exact| ≤ bound[i] in each coordinate. */
PATCHPROOF_API patchproof_status patchproof_surface_evaluate_bounded(patchproof_context* context,
    const patchproof_surface* surface, patchproof_parameters at, const patchproof_evaluate_options* options,
    patchproof_vectors point, double* bound, size_t bound_length) PATCHPROOF_NOEXCEPT;
/** lower ≤ exact ≤ upper in each coordinate. */
PATCHPROOF_API patchproof_status patchproof_surface_enclose(patchproof_context* context,
    const patchproof_surface* surface, patchproof_parameters at, const patchproof_evaluate_options* options,
    patchproof_vectors lower, patchproof_vectors upper) PATCHPROOF_NOEXCEPT;
/** The double nearest to each exact coordinate. */
PATCHPROOF_API patchproof_status patchproof_surface_evaluate_rounded(patchproof_context* context,
    const patchproof_surface* surface, patchproof_parameters at, const patchproof_evaluate_options* options,
    patchproof_vectors point) PATCHPROOF_NOEXCEPT;

enum { PATCHPROOF_SCALAR_RATIONAL = 0, PATCHPROOF_SCALAR_INTERVAL = 1 };
/** Exact values as texts, "1/3" or "2*sqrt(2)" (intervals: "[0.5, 0.75]"), of any patch of the model, at texts
 *  u v u v … (of a curve t t …). Numbers one to a line: for each item, for each derivative in the order S S_u S_v S_uu S_uv
 *  S_vv … up to the total `order`, its x, y and z. *needed counts the zero byte at the end.
 *  ERRORS PATCHPROOF_BAD_DATA: outside_domain, bad_number, unsupported (exact values of transcendental GERBS). */
PATCHPROOF_API patchproof_status patchproof_model_patch_evaluate_exact(patchproof_context* context,
    const patchproof_model* model, size_t patch, const patchproof_text* uv, size_t uv_length,
    const patchproof_evaluate_options* options, int32_t scalar, int32_t order, char* buffer, size_t length,
    size_t* needed) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_model_curve_evaluate_exact(patchproof_context* context,
    const patchproof_model* model, size_t curve, const patchproof_text* t, size_t t_length,
    const patchproof_evaluate_options* options, int32_t scalar, int32_t order, char* buffer, size_t length,
    size_t* needed) PATCHPROOF_NOEXCEPT;

/* ---- Certification --------------------------------------------------------------------------------------------- */

typedef struct patchproof_report patchproof_report;

enum {
  PATCHPROOF_CLASS_ANY = 0,
  PATCHPROOF_CLASS_C0 = 1,
  PATCHPROOF_CLASS_C1 = 2,
  PATCHPROOF_CLASS_G1 = 3,
  PATCHPROOF_CLASS_C2 = 4
};
enum { PATCHPROOF_VERDICT_PROVEN = 0, PATCHPROOF_VERDICT_REFUTED = 1, PATCHPROOF_VERDICT_UNDECIDED = 2 };
enum { PATCHPROOF_OUTCOME_PASS = 0, PATCHPROOF_OUTCOME_FAIL = 1, PATCHPROOF_OUTCOME_UNDECIDED = 2 };

typedef struct {
  size_t struct_size;
  int32_t require;            /**< every join must be proven of this class: C0, C1, G1, or ANY */
  int32_t has_gap, has_angle; /**< 1: the tolerance counts */
  int32_t has_curvature;
  double gap_tolerance;       /**< length */
  double angle_tolerance;     /**< degrees */
  double curvature_tolerance; /**< of joins of curves: difference of curvature vectors, 1/length */
  double seconds_per_join;    /**< then it ends undecided; 0: 10 */
  double match_length;        /**< edges within this length are looked at; 0: 1e-6 of the diagonal */
  int32_t jobs;               /**< threads; 0: one for each processor. The report does not depend on it */
  patchproof_text profile;    /**< thresholds for what is not set here, by the program's name: "vda4955" */
} patchproof_certify_options;
/** Finds the joins of the model, or takes the declared ones, and decides each. options and callback may be NULL. */
PATCHPROOF_API patchproof_status patchproof_certify(patchproof_context* context, const patchproof_model* model,
    const patchproof_certify_options* options, const patchproof_callback* callback,
    patchproof_report** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_report_free(patchproof_report* report) PATCHPROOF_NOEXCEPT;

typedef struct {
  size_t struct_size;
  int32_t outcome;                                         /**< over everything asked, curves as well */
  size_t joins, passed, failed, undecided;                 /**< of patches */
  size_t curve_joins, curve_passed, curve_failed, curve_undecided;
  size_t unmatched_edges;                                  /**< with no partner within match_length: they are no joins */
  size_t collapsed_edges;                                  /**< that are one point (poles) */
  size_t gregory_patches;
  double largest_gap[2], largest_angle[2];                 /**< over all joins of patches: lower and upper bound */
} patchproof_report_summary;
PATCHPROOF_API patchproof_status patchproof_report_get_summary(
    patchproof_context* context, const patchproof_report* report, patchproof_report_summary* out) PATCHPROOF_NOEXCEPT;

/** The supremum over the whole join lies in [lower, upper]; lower is attained at `point`. */
typedef struct {
  double lower, upper, point[3];
  int32_t converged; /**< upper − lower is at most 1 % of upper */
} patchproof_maximum;
typedef struct {
  int32_t verdict;
  patchproof_text reason;
} patchproof_verdict;
typedef struct {
  int32_t patch;
  patchproof_text edge;     /**< "u_min", or "u = 1/2" for a line inside the patch */
  patchproof_text range[2]; /**< exact parameters, in the order in which the join runs through them */
} patchproof_join_side;
enum {
  PATCHPROOF_ORIENTATION_SMOOTH = 0,
  PATCHPROOF_ORIENTATION_CUSP = 1,
  PATCHPROOF_ORIENTATION_MIXED = 2,
  PATCHPROOF_ORIENTATION_UNKNOWN = 3
};
/** Of a join of two patches. With t the parameter along line A and s the distance in parameters into each patch, x_t, x_s are
 *  derivatives of patch A, y_t, y_s of patch B. */
typedef struct {
  size_t struct_size;
  int32_t id; /**< its number in the table and in the JSON, from 1 */
  patchproof_join_side a, b;
  int32_t reversed;
  patchproof_verdict c0, c1, c2, g1;
  patchproof_text ratio;         /**< exact λ > 0 with y_s = −λ x_s, "" when there is none */
  patchproof_maximum gap;        /**< distance of paired points */
  patchproof_maximum angle;      /**< of the oriented normals, 0 to 180 degrees: 180 folds back */
  patchproof_maximum plane_angle; /**< of the tangent planes, 0 to 90 degrees */
  int32_t orientation;           /**< SMOOTH: B goes on across the edge everywhere; CUSP: it folds back everywhere */
  int32_t outcome;
  patchproof_text reason; /**< of the outcome */
} patchproof_join_report;
PATCHPROOF_API patchproof_status patchproof_report_get_join(patchproof_context* context,
    const patchproof_report* report, size_t join, patchproof_join_report* out) PATCHPROOF_NOEXCEPT;
/** Of two ends of curves that meet; the JSON has its exact numbers. */
typedef struct {
  size_t struct_size;
  int32_t id;
  int32_t curve_a, end_a, curve_b, end_b; /**< end: 0 where the parameter begins, 1 where it ends */
  double point[3];
  patchproof_verdict c0, c1, c2, g1, g2;
  double gap[2], angle[2], curvature[2]; /**< enclosed: distance, angle of travel (degrees), difference of curvature
                                              vectors; +infinity above where there is none */
  int32_t outcome;
  patchproof_text reason;
} patchproof_curve_join_report;
PATCHPROOF_API patchproof_status patchproof_report_get_curve_join(patchproof_context* context,
    const patchproof_report* report, size_t join, patchproof_curve_join_report* out) PATCHPROOF_NOEXCEPT;
/** Exact numbers that refute a class (C0, C1, C2, G1) of a join; found is 0 where it has no witness. */
typedef struct {
  size_t struct_size;
  int32_t found;
  patchproof_text quantity, a[2], b[2]; /**< what is not zero, at these parameters (u, v) */
  patchproof_text values;               /**< one to a line */
} patchproof_witness;
PATCHPROOF_API patchproof_status patchproof_report_get_witness(patchproof_context* context,
    const patchproof_report* report, size_t join, int32_t continuity, patchproof_witness* out) PATCHPROOF_NOEXCEPT;
enum { PATCHPROOF_REPORT_JSON = 0, PATCHPROOF_REPORT_TABLE = 1 };
/** The document of docs/formats.md ("Report"), or the table that people read. *needed counts the zero byte at the end. */
PATCHPROOF_API patchproof_status patchproof_report_write(patchproof_context* context, const patchproof_report* report,
    int32_t format, char* buffer, size_t length, size_t* needed) PATCHPROOF_NOEXCEPT;

/* ---- Gregory fill ---------------------------------------------------------------------------------------------- */

typedef struct {
  size_t struct_size;
  int32_t decimals; /**< PATCHPROOF_DECIMALS_EXACT, PATCHPROOF_DECIMALS_BINARY64 */
  int32_t repairs;  /**< 1: first make exact what misses it by repair_angle degrees at most */
  double repair_angle;
  int32_t jobs;
} patchproof_fill_options;
typedef struct {
  size_t struct_size;
  size_t faces, smooth_edges, sharp_edges, boundary_edges;
  size_t g1[3], c1[3],
      regular[3]; /**< how many are proven, refuted, undecided: edges between faces, patches, normals of patches */
  patchproof_text findings; /**< sharp edges and what is not proven, one to a line; lives as long as the model */
} patchproof_fill_summary;
/** A curve mesh (the bytes of a file of docs/formats.md, "Curve meshes") filled with one Gregory patch for each face, and
 *  the proofs of it. */
PATCHPROOF_API patchproof_status patchproof_fill(patchproof_context* context, patchproof_text curve_mesh,
    patchproof_text name, const patchproof_fill_options* options, const patchproof_callback* callback,
    patchproof_model** out, patchproof_fill_summary* summary) PATCHPROOF_NOEXCEPT;

/* ---- Tessellation ---------------------------------------------------------------------------------------------- */

typedef struct patchproof_mesh patchproof_mesh;

enum { PATCHPROOF_METHOD_ADAPTIVE = 0, PATCHPROOF_METHOD_REGULAR = 1 };
typedef struct {
  size_t struct_size;
  double chord;         /**< largest distance between surface and triangles, > 0 */
  double angle;         /**< largest angle between their normals; 0: not asked */
  size_t max_triangles; /**< 0: 2^24 */
  int32_t method, jobs;
} patchproof_tessellate_options;
/** The B-spline patches of the model as triangles, those that join sharing their vertices. Gregory patches are left out, and
 *  models with nothing else refused, as are GERBS that are no splines. */
PATCHPROOF_API patchproof_status patchproof_tessellate(patchproof_context* context, const patchproof_model* model,
    const patchproof_tessellate_options* options, const patchproof_callback* callback,
    patchproof_mesh** out) PATCHPROOF_NOEXCEPT;
PATCHPROOF_API patchproof_status patchproof_mesh_free(patchproof_mesh* mesh) PATCHPROOF_NOEXCEPT;

typedef struct {
  size_t struct_size;
  size_t vertices, triangles;
  double chord, angle;               /**< proved; chord +infinity, angle 180: no bound */
  size_t chord_misses, angle_misses; /**< triangles for which what was asked is not proved */
  size_t free_edges, cracks,
      branching_edges; /**< watertight: cracks and branching_edges are 0; closed: free_edges as well */
  int32_t oriented;
  patchproof_text notes; /**< one to a line */
} patchproof_mesh_info;
PATCHPROOF_API patchproof_status patchproof_mesh_get_info(
    patchproof_context* context, const patchproof_mesh* mesh, patchproof_mesh_info* out) PATCHPROOF_NOEXCEPT;
/** vertices: 3 numbers each; triangles: 3 numbers of vertices each; patches: of each triangle. NULL: not wanted. */
PATCHPROOF_API patchproof_status patchproof_mesh_get_data(patchproof_context* context, const patchproof_mesh* mesh,
    double* vertices, size_t vertices_length, int32_t* triangles, size_t triangles_length, int32_t* patches,
    size_t patches_length) PATCHPROOF_NOEXCEPT;
enum {
  PATCHPROOF_MESH_STL = 0,
  PATCHPROOF_MESH_OBJ = 1,
  PATCHPROOF_MESH_PLY = 2,
  PATCHPROOF_MESH_GLB = 3,
  PATCHPROOF_MESH_VTU = 4
};
/** The bytes of a file. *needed counts a zero byte at the end, which is not part of it. STL and GLB hold single precision: their
 *  vertices lie up to 1.74 · 2^-24 · (largest coordinate) beside those of the mesh, on top of its chord error. */
PATCHPROOF_API patchproof_status patchproof_mesh_write(patchproof_context* context, const patchproof_mesh* mesh,
    int32_t format, char* buffer, size_t length, size_t* needed) PATCHPROOF_NOEXCEPT;

#ifdef __cplusplus
}
#endif
