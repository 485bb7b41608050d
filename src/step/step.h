#pragma once

// One remodelling step, and the only owner of what it takes to undo it: journal, backup, and the mesh from
// before where a fresh one takes its place.
//
//   find_correspondence()   the new domain's loops by geometry, where their order alone does not say it
//   nothing moves           nothing is done
//   follow()                Strategy::reference: all vertices go where the mesh's reference takes them
//   adjust_in_place()       all boundary vertices moved to the new design, connectivity unchanged
//   change_locally()        where the structure of the boundary differs: that is changed first, in place
//   morph()                 Strategy::morph: the interior moves beside the walls or with them, what misses a
//                           bound is mended
//   replace()               what cannot move is relocated or replaced, what was touched is refined
//   regenerate()            the mesh is taken back and one of the new design generated

#include <optional>
#include <string>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/adjust.h"
#include "step/correspondence.h"
#include "step/methods.h"
#include "step/morph.h"
#include "step/rename.h"
#include "step/step_journal.h"

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
  const Domain& domain() const { return correspondence_ ? correspondence_->domain : wanted_; }
  void require_options() const;
  void require_method() const;
  RemodelResult remodel();
  void begin_journal();
  void take_back();

  bool morphs() const {
    return options_.strategy == Strategy::morph || options_.strategy == Strategy::reference;
  }
  void find_moving_loops(const Domain& from);
  void find_correspondence();
  void choose_method();
  std::optional<RemodelResult> follow();
  void leave_reference();
  List<VertexId> moved_since_before() const;
  RemodelResult finish_return();
  RemodelResult adjust_or_replace();
  bool adjust_in_place();
  RemodelResult finish_adjustment();
  bool morph();
  bool change_locally();
  bool replace();
  bool replace_by(Method method);
  bool attempt();
  bool leaves_outside_restored() const;
  bool change_under_journal();
  std::optional<List<VertexId>> change_boundary();
  std::optional<List<VertexId>> change_structure(const ReplaceOptions& options);
  Made made() const {
    return !morphing_                                 ? Made::replaced
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
  std::optional<Correspondence> correspondence_;  // where it is not by index alone
  bool structure_differs_ = false;                // of the boundary: not all segments correspond
  bool differs_in_parts_ = false;                 // and most of each loop does
  Places places_ = Places::wanted;                // of the attempt under way, where the structure differs
  std::optional<LoopIndices> moving_;  // the loops that differ, where their vertices correspond one to one
  Method method_ = Method::general;
  bool renewing_ = false;
  std::optional<Interior> morphing_;   // how the attempt under way moves the interior, if it is a morph
  bool other_discretisation_ = false;  // boundary vertices do not correspond
  bool refresh_is_due_ = false;
  AdjustCache* cache_ = nullptr;              // of the specialised method
  bool leaving_reference_ = false;            // every journal begins with the return to the reference
  std::optional<List<Point>> places_before_;  // by slot, where the step left a reference
  RemodelResult result_;
  std::string failure_;  // why a replacement could not be completed
};

}  // namespace remodel
