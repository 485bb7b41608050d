#pragma once

// The calls of the page of `remodel live`: one living mesh around one airfoil, as flat arrays.
//
// A design is its coefficients: upper, lower, te_upper, te_lower; 2 (degree + 1) + 2 numbers. Pointers are
// good until the next call. Functions that can fail return 0 then (or null), and live_error() says why; the
// mesh is as it was. Lengths are in chords, angles in degrees. Euler's flow is another instance's matter,
// which gets its meshes as arrays: it may take seconds, and the mesh goes on living meanwhile.

#include <cstdint>

// Marks the definitions of the calls, so that the linker keeps them.
#ifdef __EMSCRIPTEN__
#include <emscripten/emscripten.h>
#define LIVE EMSCRIPTEN_KEEPALIVE
#else
#define LIVE
#endif

// Of live_figures().
enum LiveFigure : std::uint32_t {
  live_triangle_count,
  live_vertex_count,
  live_kept,   // triangles that nothing has happened to in the last step
  live_moved,  // that join the same vertices, of which some have moved
  live_made,
  live_smallest_angle,
  live_fresh_triangles,  // of a mesh generated afresh; 0 until live_fresh()
  live_full_adjustment,  // 1 where the step has moved boundary vertices in place and changed nothing else
  live_regenerated,
  live_step,
  live_vertices_moved,
  live_vertices_inserted,
  live_vertices_removed,
  live_largest_gradation,  // r / (H mean LS)
  live_figure_count
};

// Of live_euler_figures().
enum LiveEulerFigure : std::uint32_t {
  live_euler_converged,  // 0 or 1; where 0, no other figure is of use but for the steps
  live_euler_start,      // a FlowStart
  live_euler_cl,
  live_euler_cd,
  live_euler_cm,
  live_euler_sonic_cp,
  live_euler_highest_mach,  // local
  live_euler_newton_steps,  // with matrices of their own
  live_euler_factorisations,
  live_euler_krylov_iterations,  // with older factors
  live_euler_corrected_vertices,
  live_euler_vertices,
  live_euler_memory_mb,  // of the factors
  live_euler_figure_count
};

extern "C" {

// Room for what is passed in; good until the next such call.
double* live_scratch(std::uint32_t bytes);
const char* live_error();

const char* live_catalogue();  // JSON: [{"name", "description"}, ...]
// These leave a design in live_design() and return its length. degree is that of a fit.
std::uint32_t live_named(const char* name, std::uint32_t degree);  // "naca:2412", or a name of the catalogue
std::uint32_t live_read(const char* text, const char* file,
                        std::uint32_t degree);  // coordinates, or .json of a fit
double* live_design();
// x, y of points with t = i / (samples - 1): from the trailing edge over the upper side and back.
double* live_outline(const double* design, std::uint32_t count, std::uint32_t samples);

// 1, or 0 and the mesh is as it was.
std::uint32_t live_generate(const double* design, std::uint32_t count, std::uint32_t points,
                            double gradation);
std::uint32_t live_update(const double* design, std::uint32_t count);  // one step, by `renew`
std::uint32_t live_regenerate();                                       // the present design, afresh
std::uint32_t live_fresh();  // counts the triangles of a fresh mesh of the present design

// Which triangles of the present mesh would be replaced by a step to this design; the mesh stays as it is.
std::uint32_t live_outlook(const double* design, std::uint32_t count);
const std::uint8_t* live_going();  // per triangle: 1 where it would

double* live_figures();
const double* live_points();            // x, y of each vertex
const std::uint32_t* live_triangles();  // three vertices each
const std::uint8_t* live_fates();       // per triangle, in the last step: 0 kept, 1 moved, 2 made
const std::uint32_t* live_births();     // per triangle: the step that made it, 0 for generation
double* live_angles();                  // per triangle: the smallest
double* live_sizes();                   // per triangle: mean length scale of its vertices
std::uint32_t* live_wall();             // the airfoil's vertices in order
std::uint32_t live_wall_count();
const std::uint32_t* live_keys();   // per vertex, two numbers: its name, for the life of this instance
const std::uint32_t* live_edges();  // of the boundary, two vertices each: the airfoil's, then the far field's
std::uint32_t live_airfoil_edges();  // how many
std::uint32_t live_farfield_edges();
const char*
live_check();  // the independent check: empty if the mesh is valid, otherwise the first broken rule
const char* live_hash();  // of points and triangles, 16 hexadecimal digits

// Potential flow around the present mesh, with pressures by Karman and Tsien's rule.
std::uint32_t live_flow(double alpha_deg, double mach);
double* live_cp();       // per vertex
double* live_mach();     // per vertex: local Mach numbers, of flow without losses at these pressures
double* live_wall_cp();  // x, cp of wall vertices, in order
std::uint32_t live_wall_cp_count();
double live_lift();      // by pressure
double live_sonic_cp();  // of that Mach number; minus infinity at 0

// Takes a mesh as another instance has it: points, triangles, keys and edges in one row of numbers each.
std::uint32_t live_euler_mesh(const double* points, const std::uint32_t* numbers, std::uint32_t vertices,
                              std::uint32_t triangles, std::uint32_t airfoil_edges,
                              std::uint32_t farfield_edges);
// The flow around that mesh, from the last one if there is one. 1 also where the search ended without a flow:
// live_euler_reason() says why then, and the last one that was found goes on serving.
std::uint32_t live_euler(double alpha_deg, double mach);
double* live_euler_figures();
const char* live_euler_reason();  // empty where the flow was found
// As those of potential flow.
double* live_euler_cp();
double* live_euler_mach();
double* live_euler_wall_cp();
std::uint32_t live_euler_wall_cp_count();

// A search by CMA-ES for the target, from another design of the same degree.
std::uint32_t live_search_start(const double* from, std::uint32_t count, const double* target,
                                std::uint32_t target_count, double sigma, std::uint32_t seed);
std::uint32_t live_search_next();  // leaves a design in live_design(); 0 where the search has converged
double live_search_objective();    // the distance of live_design() to the target, root mean square over x
void live_search_tell(double objective);
}
