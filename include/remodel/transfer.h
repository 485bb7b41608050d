#pragma once

// Values that a solver computed on a mesh, carried over to what a step, or a row of steps, has made of it.
//
//   const Mark before = mesh.mark();
//   remodel(mesh, design);
//   const Transfer transfer(mesh, before);
//   transfer.ride(FieldPlace::vertices, 4, state);  // or transfer.remap(...), which conserves
//
// Two operators. ride() is linear: whatever vertex or triangle is there still keeps its value, also where it
// has moved, and new ones are interpolated. remap() takes values as a function of space: it conserves their
// integral, is of second order, and makes no new extremum. Both leave alone what nothing has changed around.
//
// Values on triangles are values on cells where frozen meshes have quadrilaterals too: those of the
// triangles, then theirs. A quadrilateral is two triangles of its value, as with_split_quads() makes them,
// and gets the mean of its two, by areas.
//
// Sources: P. E. Farrell and J. R. Maddison, "Conservative interpolation between volume meshes by local
// Galerkin projection", Comput. Methods Appl. Mech. Eng. 200, 2011 (integrals over the intersections of old
// and new elements); F. Alauzet and M. Mehrenberger, "P1-conservative solution interpolation on unstructured
// triangular meshes", Int. J. Numer. Methods Eng. 84, 2010 (mass by element, then corrected at vertices, with
// a maximum principle); D. Kuzmin, R. Löhner and S. Turek (eds.), "Flux-Corrected Transport", 2005 (the
// limiter, element by element); T. J. Barth and D. C. Jespersen, AIAA paper 89-0366, 1989 (slopes in
// triangles). docs/transfer.md has the equations, and where we depart from these.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "remodel/changes.h"
#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"

namespace remodel {

// A linear map from values before to values after, with a row for each value that is not simply kept.
struct ValueMap {
  struct Part {
    std::uint32_t from;  // number before
    double weight;
  };
  std::size_t size_before = 0, size_after = 0;  // how many numbers there are, those of empty slots too
  // Each number after has here the one before whose value it keeps, or no_index where a row says its value,
  // if numbers are positions in frozen meshes. Empty where numbers are ids, which stay.
  std::vector<std::uint32_t> same;
  std::vector<std::uint32_t> rows;    // the new numbers, ascending
  std::vector<std::uint32_t> starts;  // row i has parts starts[i] to starts[i + 1]; one more than rows
  std::vector<Part> parts;            // the weights of a row add up to 1
  std::vector<std::uint32_t> gone;    // ids alone: those of before that name nothing now, ascending
  // How many rows are of new vertices beyond the old domain, and how far beyond, at most.
  std::size_t outside = 0;
  double farthest_outside = 0.0;

  // Adds a row of a vertex: its number is above those of the rows before.
  void add_row(std::uint32_t to, const std::array<std::uint32_t, 3>& from,
               const std::array<double, 3>& weights, double distance);
  // Values before become values after, `components` of each number one after the other. With ids in time
  // proportional to the rows. Throws Error (argument) for another number of values.
  void apply(std::vector<double>& values, int components) const;
  // The transposed map, for adjoints: sum(after * map(before)) = sum(transposed(after) * before).
  void apply_transposed(std::vector<double>& values, int components) const;
};

// The value of a new vertex or triangle beyond the old domain, where a boundary has moved, or a curved one
// has been divided.
enum class Outside {
  nearest,      // that of the nearest point of the old domain: within the bounds of the old values
  extrapolate,  // of the linear function in the nearest old triangle; remap() does so at vertices alone
  refuse,       // Error (argument) naming the place
};

struct TransferOptions {
  Outside outside = Outside::nearest;
};

struct RemapOptions {
  // No value beyond those of the old triangles that it is made of, in each component by itself. Without,
  // linear fields are exact up to the boundary on triangles too.
  bool limited = true;
  // The components that are density, momentum in x and y, and total energy, each per volume: density and
  // pressure stay positive wherever they were. These four are limited together.
  std::optional<std::array<int, 4>> conserved = {};
};

// A balance says what became of the integrals of values over the part of the domain that has changed, per
// component: after = before + gained - lost, but for rounding. The integral of values at vertices is that of
// the function that is linear on triangles.
struct Balance {
  double area_gained = 0.0,
         area_lost = 0.0;  // that moving boundaries left and swept; rounding where they rest
  std::vector<double> before, after;
  std::vector<double> gained, lost;  // of the values there
  std::size_t limited = 0;           // triangles where bounds or positivity took effect
};

// This is Transfer(mesh, mark).vertices(), alone and much sooner: all that a ride of values at vertices
// needs.
ValueMap vertex_provenance(const Mesh& mesh, const Mark& mark, const TransferOptions& options = {});

class Transfer {
 public:
  // This goes from a moment of a mesh's life to now, in time proportional to what has changed since. Values
  // are numbered by ids: those of vertex v at number v.index, triangle t's at t.index (FrozenMesh::vertex_ids
  // and triangle_ids say whose these are), for all slots, used or not. The triangles of an imported mesh are
  // those of the living mesh. Throws Error (argument) as Mesh::changes_since() does.
  Transfer(const Mesh& mesh, const Mark& mark, const TransferOptions& options = {});
  // This goes from one frozen mesh to another, in time proportional to both. Steps, regenerations, imports
  // and files may lie between them. Values are numbered by position. Vertices are the same if they have the
  // same key, and either lie in the interior at the same coordinates or on a boundary, with the same
  // parameter where both meshes know it; without keys, if they have the same coordinates.
  Transfer(const FrozenMesh& before, const FrozenMesh& after, const TransferOptions& options = {});
  ~Transfer();
  Transfer(Transfer&&) noexcept;
  Transfer& operator=(Transfer&&) noexcept;

  // Provenance: of each new vertex the corners of the old triangle that it lies in. Of each new triangle the
  // old one that its centroid lies in, with those around it that give its slope, by least squares: weights
  // may be negative.
  const ValueMap& vertices() const;
  ValueMap triangles() const;

  // How many new vertices lie beyond the old domain, and how far, at most, in chords.
  std::size_t outside() const;
  double farthest_outside() const;

  // Values before become values after. Throws Error (argument) for another number of values.
  void ride(FieldPlace place, int components, std::vector<double>& values) const;
  Balance remap(FieldPlace place, int components, std::vector<double>& values,
                const RemapOptions& options = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The integral over the domain, per component: of values at vertices as a function that is linear on
// triangles, of values on triangles as one that is constant on each.
std::vector<double> integral(const Field& field, const FrozenMesh& mesh);

}  // namespace remodel
