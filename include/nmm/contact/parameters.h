#ifndef nmm_contact_parameters_h
#define nmm_contact_parameters_h

#include <nmm/base/types.h>
#include <nmm/contact/diagnostics/locked_corners.h>
#include <nmm/contact/law/law.h>
#include <nmm/contact/surface/integration.h>
#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// The contact law between two curves or obstacles, which may be the same one.
  struct ContactPair
  {
    /// Name of a curve or obstacle on one side; empty stands for any.
    std::string first;
    /// Name of a curve or obstacle on the other side; empty stands for any.
    std::string second;
    /// Law of this pair; must not be null.
    std::shared_ptr<const ContactLaw> law;
  };


  /// The initial stress at a face that touches another one in the reference configuration.
  struct InitialFaceStress
  {
    /// The edge that it touches; invalid_index if there is none.
    unsigned int mate = invalid_index;
    /// Stress at both faces, tension positive [Pa]; where it varies, the uniform part.
    dealii::SymmetricTensor<2, 2> stress = {};
    /// Material::varying_initial_stress on both sides, whose mean is added; null: none.
    std::array<std::shared_ptr<const dealii::Function<2>>, 2> varying = {};

    /// The stress at @p x [Pa].
    dealii::SymmetricTensor<2, 2>
    at(const dealii::Point<2> &x) const
    {
      dealii::SymmetricTensor<2, 2> result = stress;
      for (const auto &function : varying)
        if (function)
          result += 0.5 * stress_at(*function, x);
      return result;
    }
  };


  /// Laws, integration and search of a Contact object. The constructor of Contact calls check().
  struct ContactParameters
  {
    /// Law of all faces to which no pair applies.
    std::shared_ptr<const ContactLaw> law;
    /// Laws between certain faces; the first pair that fits is used.
    std::vector<ContactPair> pairs;
    /// Largest weighted penetration that the augmented Lagrangian method leaves [m], see Contact;
    /// 0 selects the penalty method.
    double penetration_tolerance = 0.;
    /// Largest number of updates of the multipliers in a load step; a step that needs more fails.
    unsigned int max_augmentations = 30;
    /// Candidate pairs of faces are searched for within this distance [m]; 0 stands for a tenth
    /// of the longest edge. No point may move further than this in a step.
    double reach = 0.;
    /// Number of Gauss-Lobatto points on each piece of an edge, from 2 to 20. Round faces are divided
    /// into so short pieces that points are at most a hundredth of the relative radius of curvature
    /// apart.
    unsigned int n_points = 4;
    /// Whether springs act per length of a face or at vertices only.
    ContactIntegration integration = ContactIntegration::length;
    /// Priority of each block as the slave: of two blocks the one with the lower number is the slave,
    /// which carries the contact points. The softer or finer block is the better slave. If this is
    /// empty, it is the number of the block.
    std::vector<unsigned int> slave_priority;
    /// Stress in the reference configuration at each edge of the surface, see
    /// initial_stress_at_faces(). Springs bear its traction there. Empty: none.
    std::vector<InitialFaceStress> initial_stress;
    /// Corners of blocks that give way, see find_locked_corners(): the faces within corner_rounding of
    /// them do not touch the face ahead.
    std::vector<LockedCorner> rounded_corners;
    /// Length of the faces at these corners that gives way [m].
    double corner_rounding = 0.;

    /// Check all values and laws. @throws InputError naming the value that is out of range.
    void
    check() const;

    /// Whether any of the laws transmits shear.
    bool
    transmit_shear() const;

    /// Whether any of the laws has friction.
    bool
    has_friction() const;
  };
} // namespace NMM

#endif
