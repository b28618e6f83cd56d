#ifndef nmm_source_contact_contact_h
#define nmm_source_contact_contact_h

#include <nmm/contact/contact.h>

#include <deal.II/base/exceptions.h>

#include <base/in_order.h>
#include <contact/assembly/matrix.h>
#include <contact/assembly/point_sums.h>
#include <contact/detection/crossings.h>
#include <contact/detection/detection.h>
#include <contact/law/step_tractions.h>
#include <contact/state/memory.h>
#include <contact/state/multipliers.h>
#include <contact/surface/chosen_bodies.h>
#include <memory>
#include <vector>

namespace NMM
{
  /// The stages of Contact as objects: positions, what is kept of accepted states, candidate pairs and
  /// points, projections, tractions, matrix and sums.
  struct Contact::Data
  {
    using PointForces = internal::PointForces;
    using Positions   = internal::PointUpdater::Positions;

    Data(ContactSurface                          &surface,
         const dealii::AffineConstraints<double> &constraints,
         const ContactParameters                 &parameters);

    /// Stage that the calls of public functions have reached, see Contact.
    enum class Stage
    {
      created,
      detected,
      step_begun,
      /// The last assembly was ContactTimeStep::assemble().
      step_assembled,
      /// The last assembly was Contact::assemble().
      assembled,
      accepted
    };

    /// Assert that @p is_allowed, and go to the stage @p next.
    void
    enter(const Stage next, const bool is_allowed)
    {
      Assert(
        is_allowed,
        dealii::ExcMessage(
          "Functions of Contact have been called in another order than its "
          "documentation says."));
      (void)is_allowed;
      stage = next;
    }

    MPI_Comm
    communicator() const
    {
      return surface->cover_system().communicator();
    }

    /// Project a point at the present positions, and find its traction and its forces.
    void
    evaluate(unsigned int q, bool with_tangent, PointForces &forces);

    /// The same in the mean position of a conserving step.
    void
    evaluate_between(unsigned int q, bool with_tangent, PointForces &forces);

    /// Kinematics of a point at its projection. @p with_turning: whether its forces turn with the
    /// tangent, as they do with friction or in conserving steps.
    internal::ContactKinematics
    kinematics(unsigned int                       q,
               const internal::ContactProjection &projection,
               bool                               with_turning) const;

    /// Complete @p forces, whose projection is known, with those of a closed point under its
    /// traction, and their tangent.
    void
    find_forces(unsigned int                       q,
                const internal::ContactKinematics &kinematics,
                const internal::ContactTraction   &traction,
                bool                               with_tangent,
                PointForces                       &forces) const;

    /// Evaluate the points with these numbers by evaluate(q, forces), a function that may run on
    /// several threads, and add what they exert to matrix and sums.
    template <typename Evaluate>
    void
    add_points(const std::vector<unsigned int> &numbers,
               const Evaluate                  &evaluate);

    /// Find the chosen points that touch at the beginning or the end of the conserving step:
    /// PointSet::near_points.
    void
    find_ends();

    /// List the points of each body if not all bodies are chosen.
    void
    list_points_of_bodies();

    /// Whether the step that began at detect() takes any body through another one, the surface
    /// being at the end of the step. @p motions are the largest ones of a point of a face of each
    /// body in the step [m].
    StepFault
    find_crossing(const std::vector<double> &motions);

    ContactSurface         *surface;
    const ContactParameters parameters;
    internal::ChosenBodies  chosen;
    internal::StepStates    states;
    internal::ContactMemory memory;
    internal::Multipliers   multipliers;
    internal::Detection     detection;
    internal::PointSet      set;
    internal::PointUpdater  updater;
    internal::Tractions     tractions;
    internal::StepTractions step_tractions;
    internal::ContactMatrix matrix;
    /// Those of the last assembly.
    internal::PointSums sums;
    /// Search for crossings; null until it is needed.
    std::unique_ptr<internal::ContactCrossings> crossings;
    Stage                                       stage = Stage::created;
  };


  template <typename Evaluate>
  void
  Contact::Data::add_points(const std::vector<unsigned int> &numbers,
                            const Evaluate                  &evaluate)
  {
    internal::for_each_in_order<PointForces>(
      0,
      numbers.size(),
      [&](const unsigned int i, PointForces &forces) {
        evaluate(numbers[i], forces);
      },
      [&](const unsigned int i, PointForces &forces) {
        const unsigned int q = numbers[i];
        sums.add(set.points[q], set.data[q], forces);
        if (forces.has_forces)
          matrix.add(forces.local);
      });
    matrix.end_assembly();
    sums.end(set.points.size(), updater.is_between());
  }
} // namespace NMM

#endif
