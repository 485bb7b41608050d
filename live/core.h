#pragma once

// The calls of the page of `remodel live`: one living mesh around one airfoil, as flat arrays.
//
// A design is its coefficients: upper, lower, te_upper, te_lower; 2 (degree + 1) + 2 numbers. Pointers are
// good until the next call. Functions that can fail return 0 then (or null), and live_error() says why; the
// mesh is as it was. Cells are triangles, then quadrilaterals, which the layers on the airfoil have. Lengths
// are in chords, angles in degrees. Compressible flow, with friction or without, is another instance's
// matter, which gets its meshes as arrays: it may take seconds, and the mesh goes on living meanwhile.

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
  live_kept,   // cells that nothing has happened to in the last step
  live_moved,  // that join the same vertices, of which some have moved
  live_made,
  live_smallest_angle,   // outside the layers
  live_fresh_cells,      // of a mesh generated afresh; 0 until live_fresh()
  live_full_adjustment,  // 1 where the step has moved boundary vertices in place and changed nothing else
  live_regenerated,
  live_step,
  live_vertices_moved,
  live_vertices_inserted,
  live_vertices_removed,
  live_largest_gradation,  // r / (H mean LS), outside the layers
  live_quad_count,
  live_layer_cells,  // quadrilaterals, and the triangles beside them
  live_figure_count
};

// Of live_solve().
enum LiveModel : std::uint32_t { live_euler, live_laminar };

// Of live_solver_figures().
enum LiveSolverFigure : std::uint32_t {
  live_solver_converged,  // 0 or 1; where 0, no other figure is of use but for the steps
  live_solver_start,      // a FlowStart
  live_solver_cl,
  live_solver_cd,
  live_solver_cm,
  live_solver_sonic_cp,
  live_solver_highest_mach,  // local
  live_solver_newton_steps,  // with matrices of their own
  live_solver_factorisations,
  live_solver_krylov_iterations,  // with older factors
  live_solver_corrected_vertices,
  live_solver_vertices,
  live_solver_memory_mb,    // of the factors
  live_solver_cd_pressure,  // the parts of the drag, of models with friction
  live_solver_cd_friction,
  live_solver_figure_count
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

// 1, or 0 and the mesh is as it was. The layers are those that laminar flow at the Reynolds number wants; at
// 0 there are none. With layers there are about so many points, at the distances that layers want.
std::uint32_t live_generate(const double* design, std::uint32_t count, std::uint32_t points, double gradation,
                            double reynolds);
std::uint32_t live_update(const double* design, std::uint32_t count);  // one step, by `renew`
std::uint32_t live_regenerate();                                       // the present design, afresh
std::uint32_t live_fresh();  // counts the cells of a fresh mesh of the present design

// Which cells of the present mesh would be replaced by a step to this design; the mesh stays as it is.
std::uint32_t live_outlook(const double* design, std::uint32_t count);
const std::uint8_t* live_going();  // per cell: 1 where it would

double* live_figures();
const double* live_points();            // x, y of each vertex
const std::uint32_t* live_triangles();  // three vertices each
const std::uint32_t* live_quads();      // four each
const std::uint8_t* live_fates();       // per cell, in the last step: 0 kept, 1 moved, 2 made
const std::uint32_t* live_births();     // per cell: the step that made it, 0 for generation
double* live_angles();                  // per cell: the smallest
double* live_sizes();                   // per cell: mean length scale of its vertices
std::uint32_t* live_wall();             // the airfoil's vertices in order
std::uint32_t live_wall_count();
const std::uint32_t* live_keys();   // per vertex, two numbers: its name, for the life of this instance
const std::uint32_t* live_edges();  // of the boundary, two vertices each: the airfoil's, then the far field's
std::uint32_t live_airfoil_edges();  // how many
std::uint32_t live_farfield_edges();
const char*
live_check();  // the independent check: empty if the mesh is valid, otherwise the first broken rule
const char* live_hash();  // of points and cells, 16 hexadecimal digits

// Potential flow around the present mesh, with pressures by Karman and Tsien's rule.
std::uint32_t live_flow(double alpha_deg, double mach);
double* live_cp();       // per vertex
double* live_mach();     // per vertex: local Mach numbers, of flow without losses at these pressures
double* live_wall_cp();  // x, cp of wall vertices, in order
std::uint32_t live_wall_cp_count();
double live_lift();      // by pressure
double live_sonic_cp();  // of that Mach number; minus infinity at 0

// Takes a mesh as another instance has it. Its numbers follow each other in one row: how many vertices,
// triangles, quadrilaterals, edges of the airfoil and of the far field there are; then the last four of these
// as live_triangles(), live_quads() and live_edges() have them, and last live_keys().
std::uint32_t live_solver_mesh(const double* points, const std::uint32_t* numbers);
// The flow around that mesh by a LiveModel, from the last one of that model if there is one; the Reynolds
// number is of models with friction. 1 also where the search ended without a flow: live_solver_reason() says
// why then, and the last one that was found goes on serving.
std::uint32_t live_solve(std::uint32_t model, double alpha_deg, double mach, double reynolds);
double* live_solver_figures();
const char* live_solver_reason();  // empty where the flow was found
// As those of potential flow.
double* live_solver_cp();
double* live_solver_mach();
double* live_solver_wall_cp();
std::uint32_t live_solver_wall_cp_count();

// A search by CMA-ES for the target, from another design of the same degree.
std::uint32_t live_search_start(const double* from, std::uint32_t count, const double* target,
                                std::uint32_t target_count, double sigma, std::uint32_t seed);
std::uint32_t live_search_next();  // leaves a design in live_design(); 0 where the search has converged
double live_search_objective();    // the distance of live_design() to the target, root mean square over x
void live_search_tell(double objective);
}
