#ifndef nmm_scene_scene_parameters_fracture_h
#define nmm_scene_scene_parameters_fracture_h

#include <nmm/materials/material.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// The section `Fracture`.
  struct FractureParameters
  {
    /// The treatment of the mathematical mesh at crack tips.
    enum class Tips
    {
      /// If intensity factors are computed, tips have covers with tip functions (TipCover) in
      /// linear statics where they fit, and the mesh is graded towards all other tips.
      automatic,
      /// The mesh is graded towards crack tips, see grade_towards().
      graded,
      /// The mesh does not depend on crack tips.
      as_meshed
    };

    /// Whether the intensity factors of all tips are computed.
    bool intensity_factors = false;
    /// The treatment of the mesh at crack tips.
    Tips tips = Tips::automatic;
    /// Cell size over the distance from the tip, at the tip's free radius, see grade_towards() [-].
    double grading = 0.25;
    /// Radius of the disks about the tips [m]; 0 stands for 0.9 times each tip's free radius.
    double radius = 0.;

    /// Number of increments by which cracks grow; 0 if they do not grow.
    unsigned int n_increments = 0;
    /// Length of each increment [m].
    double increment = 0.;
    /// Name of the criterion in growth_criteria(); empty for the first one.
    std::string criterion;
    /// A tip grows together with the tip of the largest K_eq / K_c if its own K_eq / K_c is at
    /// least 1 - tolerance times that [-].
    double tolerance = 0.01;
    /// Largest speed of a crack that grows in motion [m/s]; 0 stands for half of the speed of
    /// Rayleigh waves.
    double speed = 0.;

    /// Whether the mesh is graded towards crack tips, or towards the circles of their covers.
    bool
    grades_mesh() const;

    /// Whether new cracks can start: if cracks grow and one of @p materials has a fracture strength.
    bool
    can_start_cracks(const std::vector<Material> &materials) const;

    /// The size of cells at tips in a mesh that is graded towards them, over the tip's free radius
    /// [-]: 1e-6, and 1e-3 where cracks grow @p in_motion. There all tips that a crack has had keep
    /// their cells, and faces that touch should not be divided into edges that are shorter than
    /// needed. Intensity factors are then too small by about 5e-4.
    double
    smallest_at_tips(bool in_motion) const;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError for a number that is out of range or not used.
    void
    check() const;
  };
} // namespace NMM

#endif
