#ifndef nmm_scene_scene_parameters_fracture_h
#define nmm_scene_scene_parameters_fracture_h

#include <string>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// The section `Fracture`.
  struct FractureParameters
  {
    /// What is done at crack tips.
    enum class Tips
    {
      /// The mesh is graded towards them if intensity factors are asked for.
      automatic,
      /// Cells become small towards them, see grade_towards().
      graded,
      /// Nothing: they lie in the cells of the mesh as it is.
      as_meshed
    };

    /// Are the intensity factors of all tips computed?
    bool intensity_factors = false;
    Tips tips              = Tips::automatic;
    /// See grade_towards() [-].
    double grading = 0.25;
    /// Radius of the disks about the tips [m]; 0 stands for 0.9 times each tip's free radius.
    double radius = 0.;

    /// How often cracks grow; 0: they do not.
    unsigned int n_increments = 0;
    /// Length by which a crack grows each time [m].
    double increment = 0.;
    /// See growth_criteria(); empty: the first one.
    std::string criterion;
    /// A tip grows with the one that is driven most if its drive is less by this at
    /// most [-].
    double tolerance = 0.01;

    bool
    grades_mesh() const;

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError for a number that is out of range or not used.
    void
    check() const;
  };
} // namespace NMM

#endif
