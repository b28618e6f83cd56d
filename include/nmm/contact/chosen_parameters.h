#ifndef nmm_contact_chosen_parameters_h
#define nmm_contact_chosen_parameters_h

#include <nmm/contact/law/coulomb_law.h>
#include <nmm/contact/parameters.h>
#include <nmm/contact/surface/surface.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// What contact is used for, on which the best stiffness of its springs depends.
  enum class ContactUse
  {
    /// Load steps, solved by Newton's method.
    statics,
    /// Motion in time.
    motion,
    /// Relaxation to rest, also in trials of a factor of safety.
    relaxation
  };


  /// What a user says about contact; choose_contact_parameters() adds the rest.
  struct ContactChoices
  {
    /// Makes a law; stiffnesses that it leaves open should be those of @p springs.
    using MakeLaw = std::function<std::shared_ptr<const ContactLaw>(
      const ContactLaw &springs)>;

    /// The law between two curves or obstacles, see ContactPair.
    struct Pair
    {
      /// @{
      /// Names of both sides; empty stands for any.
      std::string first, second;
      /// @}
      /// Makes the law, from the one of faces in general.
      MakeLaw law;
    };

    /// Makes the law of all faces to which no pair applies; null: springs without friction.
    MakeLaw law;
    /// Laws between certain faces; the first one that fits is used.
    std::vector<Pair> pairs;
    /// What contact is used for.
    ContactUse use = ContactUse::statics;
    /// Whether multipliers (augmented Lagrangian) reduce penetrations to a tolerance.
    bool has_multipliers = false;
    /// Whether the mesh is graded towards crack tips.
    bool has_graded_tips = false;
    /// Values of ContactParameters; law and pairs are replaced, and 0 stands for a value that is chosen
    /// for penetration_tolerance and corner_rounding.
    ContactParameters values;
    /// Directions against gravity do not lock corners, see find_locked_corners() (any unit).
    dealii::Tensor<1, 2> gravity;
    /// Displacement that locked corners have to allow [m]; 0: a small part of a cell.
    double way_at_corners = 0.;
  };


  /// Makes Coulomb's law with the coefficient of @p friction [-] and @p cohesion [Pa], and with springs
  /// that are chosen.
  ContactChoices::MakeLaw
  coulomb_friction(double friction, double cohesion = 0.);


  /**
   * The parameters of contact between the faces of @p surface. Values that are left open are
   * chosen as follows, where E is Young's modulus of the softest block and h is
   * contact_cell_size(). The normal stiffness is 10 E/h (30 E/h in statics without multipliers);
   * the shear stiffness is E/h (10 E/h in motion), but not more than the normal one; the
   * penetration tolerance of multipliers is 1e-5 h. For springs at points h is 1 m.
   * If the mesh is graded towards crack tips, the shear stiffness is the normal one, and between
   * the faces of a crack with a tip, whose factors depend on it, h is the cell size that a tenth of
   * all edges at faces lies below, but at least 0.003 of the smallest free radius of a tip. All
   * other faces do not become stiffer by the cells at tips. Of two blocks, the
   * softer one is the slave, which carries the contact points. Corners that are locked
   * (find_locked_corners()) give way within 0.01 h, or 1.5 times ContactChoices::way_at_corners.
   */
  ContactParameters
  choose_contact_parameters(const ContactSurface    &surface,
                            const ElasticityProblem &problem,
                            const ContactChoices    &choices);

  /**
   * Edge length of the smaller cells at faces [m]: a twentieth of the length of all faces lies in
   * cells that are smaller. Cells that are small about a tip or in a corner are many, but at a small part
   * of the faces: with cells of the size g r at the distance r of a tip, n of them per face reach
   * from r to (1 + g)^n r, so that half of the edges may lie within a thousandth of the length.
   * Slivers (PhysicalMesh::Region::is_sliver) are left out.
   */
  double
  contact_cell_size(const ContactSurface &surface);

  /// Largest Young's modulus of each block [Pa].
  std::vector<double>
  block_moduli(const PhysicalMesh &mesh, const ElasticityProblem &problem);
} // namespace NMM

#endif
