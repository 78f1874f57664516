/* SPDX-License-Identifier: Apache-2.0 */
#include "mitral_oracle.h"

#include <math.h>
#include <stdlib.h>

typedef long double real;

enum {
  STEPS = 256
}; /* steps of the arc length table; with more steps, no point of the paper's valve moves by more than 3e-16 */

typedef struct cubic {
  real point[4][3];
  real length_to[STEPS + 1]; /* arc length from parameter 0 to i / STEPS */
} cubic;

struct mitral_oracle {
  cubic annulus[6], anterior, scallop[3];
  real u_pm, u_al, triangle, bulge; /* bulge is tan(surface_angle) / 2 */
  /* The cleft is the parameter at one third of the closed anterior edge's length. The parameters of the closed and the open valve
   * are blended. */
  real cleft;
  real translation[3];
};

static real dot(const real *a, const real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static real norm(const real *a) { return sqrtl(dot(a, a)); }
static void cross(const real *a, const real *b, real *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
static void store(const real *a, double *b) {
  for (int i = 0; i < 3; ++i) b[i] = (double)a[i];
}
static real radians(double degrees) { return acosl(-1) * degrees / 180; }
static real blend(real opening, real closed, real open) { return (1 - opening) * closed + opening * open; }

/* ---- Cubic Bezier curves by arc length ---- */

static void evaluate(const cubic *c, real t, real *point) {
  const real s = 1 - t;
  for (int k = 0; k < 3; ++k)
    point[k] = s * s * s * c->point[0][k] + 3 * s * s * t * c->point[1][k] + 3 * s * t * t * c->point[2][k] +
               t * t * t * c->point[3][k];
}

static void differentiate(const cubic *c, real t, real *derivative) {
  const real s = 1 - t;
  for (int k = 0; k < 3; ++k)
    derivative[k] = 3 * (s * s * (c->point[1][k] - c->point[0][k]) + 2 * s * t * (c->point[2][k] - c->point[1][k]) +
                         t * t * (c->point[3][k] - c->point[2][k]));
}

static real speed(const cubic *c, real t) {
  real derivative[3];
  differentiate(c, t, derivative);
  return norm(derivative);
}

/* Returns the length of a short span by Boole's rule. */
static real piece(const cubic *c, real a, real b) {
  const real h = (b - a) / 4;
  return (b - a) / 90 *
         (7 * (speed(c, a) + speed(c, b)) + 32 * (speed(c, a + h) + speed(c, b - h)) + 12 * speed(c, a + 2 * h));
}

static void measure(cubic *c) {
  c->length_to[0] = 0;
  for (int i = 0; i < STEPS; ++i)
    c->length_to[i + 1] = c->length_to[i] + piece(c, (real)i / STEPS, (real)(i + 1) / STEPS);
}

static real length(const cubic *c) { return c->length_to[STEPS]; }

/* Returns the parameter at arc length s. Newton's method searches within one step of the table. Where Newton's method would leave
 * the bracket, bisection replaces it. */
static real parameter_at(const cubic *c, real s) {
  int first = 0, last = STEPS;
  while (last - first > 1) {
    const int middle = (first + last) / 2;
    if (c->length_to[middle] <= s)
      first = middle;
    else
      last = middle;
  }
  const real start = (real)first / STEPS;
  real low = start, high = (real)last / STEPS, t = (low + high) / 2;
  for (int i = 0; i < 100; ++i) {
    const real excess = c->length_to[first] + piece(c, start, t) - s;
    if (excess > 0)
      high = t;
    else
      low = t;
    real next = t - excess / speed(c, t);
    if (!(next >= low && next <= high)) next = (low + high) / 2; /* also bisects if the curve's speed is 0 */
    if (fabsl(next - t) < 1e-16L) return next;
    t = next;
  }
  return t;
}

/* Gives the control points of the curve between the parameters a and b. The control points are the blossom's values at (a,a,a),
 * (a,a,b), (a,b,b), (b,b,b). */
static void restrict_to(const cubic *c, real a, real b, real part[4][3]) {
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      real q[4] = {c->point[0][k], c->point[1][k], c->point[2][k], c->point[3][k]};
      for (int level = 0; level < 3; ++level) {
        const real t = level < i ? b : a;
        for (int j = 0; j < 3 - level; ++j) q[j] = (1 - t) * q[j] + t * q[j + 1];
      }
      part[i][k] = q[0];
    }
}

/* ---- The annulus ---- */

/* The endpoints P and tangents T of the paper's section "Annulus". Row 1 corrects P^5. The open annulus lies in the plane z =
 * 0. */
static void annulus_curves(const mitral_parameters *p, int is_open, cubic annulus[6]) {
  const real ap = p->AP_diameter, alpm = p->ALPM_diameter, ratio = p->ALPM_position_ratio, it = p->IT_distance;
  const real id = p->indent_depth, z = is_open ? 0 : 1, h_at = z * p->anterior_horn_height;
  const real side = 0.55L * (id / 2 + ap * (1 - ratio)), back = 0.55L / 2 * (ap * ratio + alpm / 2);
  const real P[6][3] = {{0, -ap / 2, z * p->posterior_horn_height}, {alpm / 2, ap * (ratio - 0.5L), 0},
                        {it / 2, (ap + id) / 2, 0.75L * h_at},      {0, ap / 2, h_at},
                        {-it / 2, (ap + id) / 2, 0.75L * h_at},     {-alpm / 2, ap * (ratio - 0.5L), 0}};
  const real T[6][3] = {{back, 0, 0}, {0, side, 0}, {-it / 4, 0, 0}, {-it / 4, 0, 0}, {-it / 4, 0, 0}, {0, -side, 0}};
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    for (int k = 0; k < 3; ++k) {
      annulus[i].point[0][k] = P[i][k];
      annulus[i].point[1][k] = P[i][k] + T[i][k];
      annulus[i].point[2][k] = P[next][k] - T[next][k];
      annulus[i].point[3][k] = P[next][k];
    }
    measure(&annulus[i]);
  }
}

static real annulus_length(const cubic annulus[6]) {
  real sum = 0;
  for (int i = 0; i < 6; ++i) sum += length(&annulus[i]);
  return sum;
}

/* Gives A(u) and the unit vector along A'(u). Where the paper says "resampled uniformly", it means by arc length. */
static void annulus_at(const cubic annulus[6], real u, real *point, real *tangent) {
  real s = u * annulus_length(annulus);
  int i = 0;
  while (i < 5 && s > length(&annulus[i])) s -= length(&annulus[i++]);
  const real t = parameter_at(&annulus[i], s);
  evaluate(&annulus[i], t, point);
  differentiate(&annulus[i], t, tangent);
  const real magnitude = norm(tangent);
  for (int k = 0; k < 3; ++k) tangent[k] /= magnitude;
}

/* ---- The leaflets' free edges ---- */

/* Rows 2 to 4: U(u, x) is at the distance x from A(u). The angle 0 means inwards, and 90 degrees means down. The closed state has
 * angle 0 and leaves out A's z ("Closed valve"). The open annulus has no z, so both states start at z = 0. */
static void reach(const cubic annulus[6], real u, double x, double inward_angle, real *point) {
  real a[3], tangent[3];
  annulus_at(annulus, u, a, tangent);
  const real in = x * cosl(radians(inward_angle)) / hypotl(tangent[0], tangent[1]);
  point[0] = a[0] - in * tangent[1];
  point[1] = a[1] + in * tangent[0];
  point[2] = -x * sinl(radians(inward_angle));
}

static real twice_area(const real *a, const real *b, const real *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* The code follows the paper's section "Leaflets" up to the matrix M, with rows 5 to 8. M is affine on the arc's plane, and maps
 * S^0, S^3 and S^tip to start, end and tip. A point therefore keeps its barycentric coordinates. (S^cen is a mean of points, so M
 * also maps it.) */
static void leaflet_curve(const real *start, const real *tip, const real *end, double arc_angle, real curve[4][3]) {
  const real a = radians(arc_angle), k = 4.0L / 3 * tanl(a / 4);
  const real S[4][2] = {{1, 0}, {1, k}, {cosl(a) + k * sinl(a), sinl(a) - k * cosl(a)}, {cosl(a), sinl(a)}};
  const real S_tip[2] = {cosl(a / 2), sinl(a / 2)}, whole = twice_area(S[0], S[3], S_tip);
  for (int i = 0; i < 4; ++i) {
    const real of_start = twice_area(S[i], S[3], S_tip) / whole, of_end = twice_area(S[0], S[i], S_tip) / whole;
    const real of_tip = twice_area(S[0], S[3], S[i]) / whole;
    for (int c = 0; c < 3; ++c) curve[i][c] = of_start * start[c] + of_end * end[c] + of_tip * tip[c];
  }
}

static real u_pm_of(const mitral_parameters *p) { return 0.5L - (real)p->anterior_ratio / 2; }

/* The curve L_at. Row 9: both ends of the curve use the same commissure parameter. */
static void anterior_curve(const mitral_parameters *p, const cubic annulus[6], double inward_angle, real curve[4][3]) {
  const real u_pm = u_pm_of(p);
  real start[3], tip[3], end[3];
  reach(annulus, u_pm, p->posteromedial_commissure_height, inward_angle, start);
  reach(annulus, 0.5L, p->anterior_length, inward_angle, tip);
  reach(annulus, 1 - u_pm, p->posteromedial_commissure_height, inward_angle, end);
  leaflet_curve(start, tip, end, p->leaflet_arc_angle, curve);
}

/* The open scallops from pm to al, rows 10 to 12. The ends of the scallops have the height h_pm and are 2 u_pm / 3 apart. Each
 * tip is half way between two ends. */
static void open_scallop(const mitral_parameters *p, const cubic annulus[6], int scallop, real curve[4][3]) {
  const real third = u_pm_of(p) / 3, ends[4] = {3 * third, third, 1 - third, 1 - 3 * third};
  const real tips[3] = {2 * third, 0, 1 - 2 * third};
  const double tip_length = scallop == 1 ? p->posterior_scallop_length2 : p->posterior_scallop_length1;
  real start[3], tip[3], end[3];
  reach(annulus, ends[scallop], p->posteromedial_commissure_height, p->leaflet_inward_angle, start);
  reach(annulus, tips[scallop], tip_length, p->leaflet_inward_angle, tip);
  reach(annulus, ends[scallop + 1], p->posteromedial_commissure_height, p->leaflet_inward_angle, end);
  leaflet_curve(start, tip, end, p->leaflet_arc_angle, curve);
}

/* ---- The valve between closed and open: row 17 ---- */

static void blend_curve(real opening, real closed[4][3], real open[4][3], cubic *blended) {
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) blended->point[i][k] = blend(opening, closed[i][k], open[i][k]);
  measure(blended);
}

typedef struct states { /* on the heap, because it contains tables of 14 curves */
  cubic closed_annulus[6], open_annulus[6], closed_anterior, open_anterior;
  cubic cleft_annulus[6], cleft_anterior;
} states;

/* Returns the parameter at one third of the closed anterior edge's length. */
static real cleft_of(const mitral_parameters *p, cubic annulus[6], cubic *anterior) {
  annulus_curves(p, 0, annulus);
  anterior_curve(p, annulus, 0, anterior->point);
  measure(anterior);
  return parameter_at(anterior, length(anterior) / 3);
}

static void build(mitral_oracle *o, states *s, const mitral_parameters *closed, const mitral_parameters *open) {
  const real opening = closed->opening;
  annulus_curves(closed, 0, s->closed_annulus);
  annulus_curves(open, 1, s->open_annulus);
  for (int i = 0; i < 6; ++i)
    blend_curve(opening, s->closed_annulus[i].point, s->open_annulus[i].point, &o->annulus[i]);

  anterior_curve(closed, s->closed_annulus, 0, s->closed_anterior.point);
  anterior_curve(open, s->open_annulus, open->leaflet_inward_angle, s->open_anterior.point);
  blend_curve(opening, s->closed_anterior.point, s->open_anterior.point, &o->anterior);

  measure(&s->closed_anterior);
  o->cleft = blend(opening, cleft_of(closed, s->cleft_annulus, &s->cleft_anterior),
                   cleft_of(open, s->cleft_annulus, &s->cleft_anterior));
  for (int i = 0; i < 3; ++i) {
    const real third = length(&s->closed_anterior) / 3;
    const real from = i == 0 ? 0 : parameter_at(&s->closed_anterior, i * third);
    const real to = i == 2 ? 1 : parameter_at(&s->closed_anterior, (i + 1) * third);
    real closed_part[4][3], open_part[4][3];
    restrict_to(&s->closed_anterior, from, to, closed_part);
    open_scallop(open, s->open_annulus, i, open_part);
    blend_curve(opening, closed_part, open_part, &o->scallop[i]);
  }

  o->u_pm = blend(opening, u_pm_of(closed), u_pm_of(open));
  o->u_al = 1 - o->u_pm;
  o->triangle = blend(opening, closed->triangle_size_ratio, open->triangle_size_ratio);
  o->bulge = blend(opening, tanl(radians(closed->surface_angle)), tanl(radians(open->surface_angle))) / 2;
  for (int k = 0; k < 3; ++k) o->translation[k] = blend(opening, closed->translation[k], open->translation[k]);
}

/* ---- The surface ---- */

static void by_length(const cubic *c, real share, real *point) {
  evaluate(c, parameter_at(c, share * length(c)), point);
}

/* Gives L_po(v) for v in [0, 1] from pm to al. Row 13: each scallop takes a third of v's range. */
static void posterior(const mitral_oracle *o, real v, real *point) {
  const int scallop = 3 * v < 1 ? 0 : 3 * v < 2 ? 1 : 2;
  by_length(&o->scallop[scallop], 3 * v - scallop, point);
}

/* Gives L(u) in the cases of the paper's section "Leaflet surfaces". The number 1 - r_at equals 2 u_pm. */
static void leaflet_at(const mitral_oracle *o, real u, real *point) {
  const real first = o->u_pm + o->triangle, last = o->u_al - o->triangle;
  if (u < o->u_pm)
    posterior(o, 0.5L - u / (2 * o->u_pm), point);
  else if (u > o->u_al)
    posterior(o, 1 - (u - o->u_al) / (2 * o->u_pm), point);
  else
    by_length(&o->anterior, u <= first ? 0 : u >= last ? 1 : (u - first) / (last - first), point);
}

/* Gives A(u), K(u) and L(u). Rows 14 and 15: K is the chord's middle, shifted by tan(surface_angle) |L - A| / 2 along (L - A) x
 * A'. If L - A and A' are parallel, K is not shifted. */
static void curve_at(const mitral_oracle *o, real u, real *a, real *k, real *l) {
  real t[3], e[3], n[3];
  annulus_at(o->annulus, u, a, t);
  leaflet_at(o, u, l);
  for (int i = 0; i < 3; ++i) e[i] = l[i] - a[i];
  cross(e, t, n);
  const real offset = norm(n) > 0 ? o->bulge * norm(e) / norm(n) : 0;
  for (int i = 0; i < 3; ++i) k[i] = (a[i] + l[i]) / 2 + offset * n[i];
}

/* Gives D(u, v) before the translation. */
static void quadratic(const real *a, const real *k, const real *l, real v, real *point) {
  for (int i = 0; i < 3; ++i) point[i] = (1 - v) * (1 - v) * a[i] + 2 * v * (1 - v) * k[i] + v * v * l[i];
}

static real triangle_area(const real *a, const real *b, const real *c) {
  real e[3], f[3], n[3];
  for (int i = 0; i < 3; ++i) e[i] = b[i] - a[i], f[i] = c[i] - a[i];
  cross(e, f, n);
  return norm(n) / 2;
}

/* ---- Interface ---- */

mitral_parameters mitral_defaults(void) {
  const mitral_parameters p = {0.41, 3.0,  4.0,  0.55, 2.5, 0.5, 0.8, 0.6, 2.12,
                               0.8,  1.35, 1.35, 120,  75,  20,  0.1, 1,   {0, 0, 1}};
  return p;
}

mitral_oracle *mitral_oracle_create(const mitral_parameters *closed, const mitral_parameters *open) {
  mitral_oracle *oracle = malloc(sizeof *oracle);
  states *work = malloc(sizeof *work);
  if (oracle && work) {
    build(oracle, work, closed, open);
  } else {
    free(oracle);
    oracle = NULL;
  }
  free(work);
  return oracle;
}

void mitral_oracle_destroy(mitral_oracle *oracle) { free(oracle); }

void mitral_oracle_annulus(const mitral_oracle *oracle, double u, double *point) {
  real a[3], tangent[3];
  annulus_at(oracle->annulus, u, a, tangent);
  store(a, point);
}

void mitral_oracle_annulus_derivative(const mitral_oracle *oracle, double u, double *derivative) {
  real a[3], tangent[3];
  annulus_at(oracle->annulus, u, a, tangent);
  for (int k = 0; k < 3; ++k) tangent[k] *= annulus_length(oracle->annulus);
  store(tangent, derivative);
}

void mitral_oracle_leaflet(const mitral_oracle *oracle, double u, double *point) {
  real l[3];
  leaflet_at(oracle, u, l);
  store(l, point);
}

void mitral_oracle_point(const mitral_oracle *oracle, double u, double v, double *point) {
  real a[3], k[3], l[3], d[3];
  curve_at(oracle, u, a, k, l);
  quadratic(a, k, l, v, d);
  for (int i = 0; i < 3; ++i) d[i] += oracle->translation[i];
  store(d, point);
}

static void breaks(const mitral_oracle *o, real *u) {
  const real at[MITRAL_ORACLE_BREAKS] = {
      0, o->u_pm / 3, o->u_pm, o->u_pm + o->triangle, o->u_al - o->triangle, o->u_al, 1 - o->u_pm / 3, 1};
  for (int i = 0; i < MITRAL_ORACLE_BREAKS; ++i) u[i] = at[i];
}

void mitral_oracle_breaks(const mitral_oracle *oracle, double *u) {
  real at[MITRAL_ORACLE_BREAKS];
  breaks(oracle, at);
  for (int i = 0; i < MITRAL_ORACLE_BREAKS; ++i) u[i] = (double)at[i];
}

double mitral_oracle_anterior_cleft(const mitral_oracle *oracle) {
  const int whole = (int)(oracle->cleft * STEPS);
  const real behind = oracle->anterior.length_to[whole] + piece(&oracle->anterior, (real)whole / STEPS, oracle->cleft);
  const real first = oracle->u_pm + oracle->triangle;
  return (double)(first + behind / length(&oracle->anterior) * (1 - 2 * first));
}

double mitral_oracle_annulus_length(const mitral_oracle *oracle) { return (double)annulus_length(oracle->annulus); }
double mitral_oracle_anterior_length(const mitral_oracle *oracle) { return (double)length(&oracle->anterior); }
double mitral_oracle_scallop_length(const mitral_oracle *oracle, int scallop) {
  return (double)length(&oracle->scallop[scallop]);
}

double mitral_oracle_area(const mitral_oracle *oracle, int n_u, int n_v) {
  real u[MITRAL_ORACLE_BREAKS], sum = 0;
  real curve[2][3][3]; /* the curves at the last two values of u */
  breaks(oracle, u);
  for (int b = 0; b + 1 < MITRAL_ORACLE_BREAKS; ++b)
    for (int i = 0; i <= n_u; ++i) {
      real(*before)[3] = curve[(i + 1) % 2], (*last)[3] = curve[i % 2];
      curve_at(oracle, u[b] + (u[b + 1] - u[b]) * i / n_u, last[0], last[1], last[2]);
      for (int j = 0; j < n_v && i > 0; ++j) {
        real p[2][2][3];
        for (int k = 0; k < 2; ++k) {
          quadratic(before[0], before[1], before[2], (real)(j + k) / n_v, p[0][k]);
          quadratic(last[0], last[1], last[2], (real)(j + k) / n_v, p[1][k]);
        }
        sum += triangle_area(p[0][0], p[1][0], p[1][1]) + triangle_area(p[0][0], p[1][1], p[0][1]);
      }
    }
  return (double)sum;
}
