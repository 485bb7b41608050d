#pragma once

// One remodelling step: a mesh of one domain becomes a mesh of another one, in place. This class is the only
// owner of what takes a step back: the journal, copies of what has none, and the mesh from before where a
// fresh one has taken its place. Source: the paper's sections 3 (general method) and 4.2 (specialised
// method).
//
// 1. Compare (StepPlan). Loops of the two domains are paired, by their order where that is beyond doubt,
//    otherwise by geometry. The result says which loops move with all their vertices in correspondence, and
//    whether the structure of the boundary differs. Where nothing moves the step ends here. Where names alone
//    differ the mesh takes the new ones first.
// 2. Follow, for Strategy::reference and for meshes that it has held: all vertices go where the mesh's
//    reference takes them (follow.h). If that is no valid mesh the step starts from the reference.
// 3. Adjust (adjust_all()). All boundary vertices go to their places on the new design. The interior stays
//    and so does connectivity. This *full adjustment* is accepted if every triangle at a moved vertex is
//    counter-clockwise, Delaunay and good. Most steps of a converging optimiser end here, without a journal:
//    everything is checked before anything moves, and nothing can fail afterwards.
// 4. Otherwise make the attempts of the plan in turn, each under a journal, until one succeeds:
//      a. connectivity is to be kept (Strategy::morph, reference): vertices beside the walls move too, then
//         the whole interior moves along (morph.h);
//      b. the specialised method: what can be adjusted is, what cannot is relocated or replaced
//         (specialised.cpp);
//      c. the general method: the boundary is taken out and the new one put in (general.cpp).
//    Where the structure of the boundary differs, (a) and (b) change that first, while all that corresponds
//    stays where it is, and move that afterwards.
//    Every attempt ends alike. Strategy::renew, and all that build on it, renew length scales and coarsen
//    (renew.h, coarsen.h). Then refinement looks at the triangles that were touched (refine.h), and what is
//    lost and what is kept is counted (outcome.h).
// 5. If no attempt succeeds the mesh is taken back, and one of the new design is generated; or it stays as it
//    was, if RemodelOptions::regenerate is off.
//
// What can fail, and what then holds:
//
//   what                                          where                  then
//   -------------------------------------------   ---------------------- ------------------------------------
//   an option out of range, an empty mesh, a      require_options(),     Error; nothing was touched
//   trial under way                               require_mesh()
//   the new domain is none: curves cross, loops   compare_domains(),     Error; nothing was touched, or it is
//   do not nest, an airfoil's surfaces touch      adjust_or_replace()    taken back
//   Method::specialised does not apply            require_method()       Error; names are taken back
//   a vertex or triangle spoils an adjustment     adjust_all()           no vertex has moved; step 4
//   a held mesh misses a bound                    follow_reference()     no vertex has moved; step 3 from the
//                                                                        reference
//   triangles turn over in a morph                morph_mesh()           rolled back; the next attempt
//   a boundary edge cannot be recovered           RecoveryError          rolled back; the next attempt
//   refinement meets a limit or runs away         refine_touched()       rolled back; the next attempt after
//                                                                        a morph or a change of structure,
//                                                                        step 5 after a replacement
//   no attempt succeeds                           attempt_in_turn()      rolled back; step 5, with the reason
//   generation fails: the domain cannot be        regenerate()           Error; the mesh is as it was
//   meshed
//   generation meets a limit                      regenerate()           a valid mesh; `stopped` names it
//   the observer cancels                          anywhere               Stopped::interrupted; as it was
//   memory runs out, the observer throws          anywhere               passes through; as it was
//
// "As it was" and "taken back" mean to the last bit, ids included. A Trial journals a full adjustment too, so
// that it can take back a step that succeeded.

#include <optional>
#include <string>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/adjust.h"
#include "step/rename.h"
#include "step/step_journal.h"
#include "step/step_plan.h"

namespace remodel {

class Step {
 public:
  // Whether a full adjustment is journalled too: only then can it be taken back.
  enum class Journal { when_needed, always };
  // How the triangles came to be that refinement looks at.
  enum class Made { replaced, morphed, reference };

  // The domain and the options have to live as long as run() does.
  Step(Mesh& mesh, const Domain& domain, const RemodelOptions& options, Journal journal);
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;
  // Takes the step back, to the last bit, unless it is kept. A full adjustment without a journal stays.
  ~Step();

  // Once. Throws Error, as remodel() does, where the step is impossible; what it throws leaves the mesh to
  // the destructor.
  RemodelResult run();
  void keep();

 private:
  MeshData& data() { return mesh_.data(); }
  bool cancelled() const { return options_.observer != nullptr && options_.observer->cancelled(); }
  const Domain& domain() const { return plan_.target(wanted_); }
  bool keeps_connectivity() const {
    return options_.strategy == Strategy::morph || options_.strategy == Strategy::reference;
  }
  void require_options() const;
  void require_method() const;
  RemodelResult remodel();
  void begin_journal();
  void take_back();

  void compare_domains();
  void choose_method();
  void open_hull_that_moves();
  std::optional<RemodelResult> follow();
  void leave_reference();
  List<VertexId> moved_since_before() const;
  RemodelResult finish_return();
  RemodelResult adjust_or_replace();
  bool adjust_in_place();
  RemodelResult finish_adjustment();
  bool attempt_in_turn();
  bool make_attempt();
  void forget_attempt();
  bool leaves_outside_restored() const;
  bool change_under_journal();
  std::optional<List<VertexId>> change_boundary();
  std::optional<List<VertexId>> change_structure(const ReplaceOptions& options);
  std::optional<List<VertexId>> move_or_replace(const ReplaceOptions& options);
  Made made() const {
    return !attempt_.interior                         ? Made::replaced
           : options_.strategy == Strategy::reference ? Made::reference
                                                      : Made::morphed;
  }
  QualityBounds bounds_of_morph() const;
  void note_replacement();
  void shed_and_refine();
  Stopped what_still_stops();
  RemodelResult abandon();
  RemodelResult regenerate();
  RemodelResult exchange(GenerateResult&& fresh);

  Mesh& mesh_;
  const Domain& wanted_;
  const RemodelOptions& options_;
  const Journal journalling_;
  const double keep_before_;   // the mesh's own
  const bool outside_before_;  // likewise
  const ChangeRecords::Moment marked_before_;
  bool kept_ = false;
  std::optional<StepJournal> journal_;
  std::optional<Mesh> before_;  // where a fresh mesh has taken its place

  // What was renamed before all else; taken back after all else.
  std::optional<Renaming> renaming_;

  // While it runs.
  StepPlan plan_;
  Attempt attempt_;                           // the one under way
  AdjustCache* cache_ = nullptr;              // of the loops that move in it; none where all are replaced
  bool refresh_is_due_ = false;               // after a full adjustment
  std::optional<List<Point>> places_before_;  // by slot, where the step left a reference
  RemodelResult result_;
  std::string failure_;  // why the last attempt could not be completed
};

}  // namespace remodel
