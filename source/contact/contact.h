#ifndef nmm_source_contact_contact_h
#define nmm_source_contact_contact_h

#include <nmm/contact/contact.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <base/in_order.h>
#include <contact/assembly/chosen_bodies.h>
#include <contact/assembly/matrix.h>
#include <contact/assembly/point_springs.h>
#include <contact/assembly/point_sums.h>
#include <contact/assembly/point_terms.h>
#include <contact/assembly/spring_energies.h>
#include <contact/detection/crossings.h>
#include <contact/detection/point_maker.h>
#include <contact/detection/point_projector.h>
#include <contact/detection/points.h>
#include <contact/detection/search.h>
#include <contact/state/memory.h>
#include <contact/state/multipliers.h>
#include <contact/state/point_data.h>
#include <memory>
#include <vector>

namespace NMM
{
  struct Contact::Data
  {
    using Dilation    = internal::Dilation;
    using PointData   = internal::PointData;
    using PointForces = internal::PointForces;

    Data(ContactSurface                          &surface,
         const dealii::AffineConstraints<double> &constraints,
         const ContactParameters                 &parameters);

    /// Stage that the calls of public functions have reached, see Contact.
    enum class Stage
    {
      created,
      detected,
      assembled,
      step_begun,
      /// The last assembly was ContactTimeStep::assemble().
      step_assembled,
      /// The last assembly was Contact::assemble() at the end of a step of
      /// ContactTimeStep::assemble().
      step_ended,
      accepted,
      /// The end of a step with ContactTimeStep::assemble() has been accepted.
      step_accepted
    };

    enum class Problem
    {
      statics,
      /// Statics with linearized geometry, see Contact::freeze_geometry().
      statics_of_frozen_geometry,
      /// A time step has begun.
      motion,
      /// A time step with linearized geometry has begun.
      motion_of_frozen_geometry,
      /// A time step with ContactTimeStep::assemble() has been tried.
      conserving_motion
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

    /// Whether points have been made and the last step has not been accepted.
    bool
    is_within_step() const
    {
      return stage != Stage::created && stage != Stage::accepted &&
             stage != Stage::step_accepted;
    }

    /// Whether contact points are those of a step with ContactTimeStep::assemble(), or of its end.
    bool
    is_between() const
    {
      return stage == Stage::step_assembled || stage == Stage::step_ended ||
             stage == Stage::step_accepted;
    }

    bool
    is_moving() const
    {
      return problem == Problem::motion ||
             problem == Problem::motion_of_frozen_geometry ||
             problem == Problem::conserving_motion;
    }

    bool
    is_conserving() const
    {
      return problem == Problem::conserving_motion;
    }

    bool
    is_geometry_frozen() const
    {
      return problem == Problem::statics_of_frozen_geometry ||
             problem == Problem::motion_of_frozen_geometry;
    }

    /// Move all faces to the displacements @p u (locally relevant).
    void
    move_to(const Vector &u);

    /// Set the states of the step: the state at the end is @p end in the chosen bodies, and the one
    /// in the middle is the mean of both ends.
    void
    set_step_states(const Vector &end);

    /// Move the faces of chosen bodies to the displacements at the end and in the middle of the
    /// step. The surface is left at the end of the step.
    void
    update_faces();

    /// Move the faces of chosen bodies to the displacements of ContactTimeStep::expect().
    void
    move_as_expected();

    /// Put the points that touch at the present end of the step into the sparsity pattern, and no
    /// others. The faces must be at the end of the step as its first assembly, or
    /// ContactTimeStep::expect(), has it. The pattern depends only on the state at the beginning of the
    /// step, so that a computation that continues from a checkpoint has the same one.
    void
    couple_expected();

    /// Projection for Contact::freeze_geometry(). It is the same in every assembly after detect(),
    /// except for the gap, which is that of the displacements.
    internal::ContactProjection
    project_frozen(unsigned int q, const ContactSurface::Place &slave);

    /// The nearest master of a point at the current positions. When a point first has a master, its
    /// weight and its anchor are set.
    internal::ContactProjection
    project(unsigned int q, const ContactSurface::Place &slave);

    /// Let new contact be as deep as the problem admits, see PointProjector.
    void
    set_admitted_depth();

    void
    note_touching();

    /// Record that two edges penetrate each other.
    void
    note_touching(unsigned int edge, unsigned int master);

    /// Vector from the anchor of a point to the point [m]; in statics computed from displacements
    /// as PointProjector::gap_of_displacements().
    dealii::Tensor<1, 2>
    way_from_stick(unsigned int q, const ContactSurface::Place &slave) const;

    /// Parameter of the anchor of a point that has none. Where the point lies on its master in the
    /// reference configuration it is that place, at which the point has the initial shear; elsewhere
    /// the point begins without shear.
    double
    new_anchor(unsigned int                       q,
               const internal::ContactProjection &projection) const;

    /// @name One point in an assembly
    /// @{
    /// Evaluate the points with these numbers by evaluate(q, forces), a function that may run on
    /// several threads, and add what they exert.
    template <typename Evaluate>
    void
    add_points(const std::vector<unsigned int> &numbers,
               const Evaluate                  &evaluate);

    /// Add the forces of one point to the matrix, the residual and the report.
    void
    take_point(unsigned int q, PointForces &forces);

    /// Forces and tangent of a point under its traction.
    void
    find_forces(unsigned int                     q,
                const internal::ContactTraction &traction,
                bool                             with_tangent,
                PointForces                     &forces) const;

    /// Positions of the slaves of some contact points.
    std::vector<unsigned int>
    slaves_of(const std::vector<unsigned int> &numbers) const;

    /// Find the chosen points that touch at the beginning or the end of the step: near_points.
    void
    find_ends();

    /// A point at the end of a step: whether it touches there or at the beginning, and whether it
    /// has been closed until now and does not.
    struct PointEnd
    {
      bool is_near = false, has_opened = false;
    };

    /// Project a point at the end of a step. A point that is not near is set open.
    PointEnd
    find_end(unsigned int q);

    /// Evaluate a point in the mean position of the step.
    void
    evaluate_between(unsigned int q, bool with_tangent, PointForces &forces);

    /// Motion of the slave relative to the master in the step [m].
    dealii::Tensor<1, 2>
    relative_motion(unsigned int                       q,
                    const internal::ContactProjection &projection) const;

    /// Mean pressure of the spring and dashpot of a point in a step, and the energy lost. @p
    /// opening: relative normal motion of both faces [m].
    void
    find_pressure_between(unsigned int               q,
                          double                     opening,
                          internal::ContactTraction &traction);

    /// Derivatives by the displacements of slave and master in the middle of the step: of the mean
    /// pressure, times the weight, and of half of the slip.
    void
    differentiate_step(unsigned int                       q,
                       const internal::ContactProjection &projection,
                       const internal::ContactKinematics &kinematics,
                       double                            *pressure_change,
                       double *half_slip_change) const;

    /// Opening by dilation at the current positions. Since the last accepted state a closed point
    /// slides as far as its strength does not hold it, and an open one without strength. Sets the
    /// slip of the point.
    Dilation
    find_dilation(unsigned int                       q,
                  const ContactSurface::Place       &slave,
                  const internal::ContactProjection &projection);

    /// Upper bound on the closure of springs by the initial stress, over all edges and laws, but at
    /// most the reach [m].
    double
    bound_initial_closure() const;

    /// Set the cohesion that points keep in a step of frozen geometry.
    void
    keep_cohesion();

    /// Shear of the spring of a point if nothing slides [Pa].
    double
    trial_shear(unsigned int                       q,
                const ContactSurface::Place       &slave,
                const internal::ContactProjection &projection) const;

    /// Upper bound on the opening of all points of all ranks at the last accepted state [m].
    double
    largest_opening() const;

    /// Limit the @p trial shear [Pa] by the strength, and choose between stick and slip. @p
    /// stiffness is the derivative of the trial shear [Pa/m].
    void
    find_shear(unsigned int               q,
               double                     trial,
               double                     stiffness,
               bool                       was_slipping,
               internal::ContactTraction &traction);

    /// Shear in a step, and its work.
    void
    find_shear_between(unsigned int                       q,
                       const internal::ContactProjection &projection,
                       const dealii::Tensor<1, 2>        &motion,
                       bool                               was_slipping,
                       internal::ContactTraction         &traction);

    /// Evaluate a point at the present positions.
    void
    evaluate(unsigned int q, bool with_tangent, PointForces &forces);

    /// Pressure and shear of a point, and their derivatives; adds the energy of its springs.
    internal::ContactTraction
    find_traction(unsigned int                       q,
                  const ContactSurface::Place       &slave,
                  const internal::ContactProjection &projection,
                  double                            &energy);

    /// @}

    double
    accept_shear(unsigned int q);

    /// Points that belong to a chosen body, ascending; valid until the next call.
    const std::vector<unsigned int> &
    chosen_points();

    /// List the points of each body if not all bodies are chosen.
    void
    list_points_of_bodies();

    /// Whether the step that began at detect() takes any body through another one, the surface
    /// being at the end of the step. @p motions are the largest ones of a point of a face of each
    /// body in the step [m].
    StepFault
    find_crossing(const std::vector<double> &motions);

    /// Estimated rounding of the force of a point [N/m].
    double
    force_rounding(unsigned int                       q,
                   const internal::ContactProjection &projection,
                   const internal::ContactTraction   &traction) const;

    /// Normal motions of a step that are much less than this say nothing about whether the faces
    /// turn [m].
    double
    least_motion() const
    {
      return 1e-4 * reach;
    }

    /// The springs of all closed points.
    std::vector<internal::PointSprings>
    closed_springs() const;

    /// Bodies of a point, the lower number first.
    std::pair<unsigned int, unsigned int>
    bodies(const unsigned int q) const
    {
      return std::minmax(surface->edges()[points[q].edge].body,
                         surface->edges()[points[q].master].body);
    }

    /// Let each pair of bodies store no more than at the last accepted state, see
    /// ContactTimeStep::begin().
    void
    keep_energies();

    /// Data of a time step, from ContactTimeStep::begin() to accept().
    struct Step
    {
      /// Displacements at detect(), where the step begins, and its time [s].
      std::vector<dealii::Tensor<1, 2>> nodal_begin;
      double                            time_detected = 0.;
      /// Time of ContactTimeStep::begin(), and time from there to the end of the step [s].
      double time_begin = 0., length = 0.;
      /// Faces at the end and in the middle of the step, and displacements of obstacles in the step
      /// [m].
      ContactSurface::State             end, middle;
      std::vector<dealii::Tensor<1, 2>> obstacle_changes;
      /// Displacements of ContactTimeStep::expect(); empty if there are none.
      std::vector<dealii::Tensor<1, 2>> nodal_expected;
      /// Chosen points that touch at the beginning or the end of the step.
      std::vector<unsigned int> near_points;
      /// Energy lost between the last accepted state and the beginning of the step [J/m].
      double detection_loss = 0.;
    };

    /// Linearized geometry, see Contact::freeze_geometry(). For each point: its projection at the
    /// first assembly after detect(), and the difference between its gap and that of the
    /// displacements [m].
    struct FrozenPoint
    {
      internal::ContactProjection projection;
      double                      gap      = 0.;
      bool                        is_known = false;
    };

    ContactSurface         *surface;
    ContactParameters       parameters;
    MPI_Comm                communicator;
    internal::ContactSearch search;
    internal::ContactLaws   laws;
    bool                    transmits_shear;
    /// See bound_initial_closure().
    double                largest_initial_closure = 0.;
    internal::Multipliers multipliers;

    internal::ContactMemory  memory;
    internal::PointMaker     maker;
    internal::PointProjector projector;
    internal::ChosenBodies   chosen;
    internal::ContactMatrix  matrix;
    Step                     step;
    std::vector<FrozenPoint> frozen;
    /// Search for crossings; null until it is needed.
    std::unique_ptr<internal::ContactCrossings> crossings;

    std::vector<dealii::Tensor<1, 2>> nodal;
    std::vector<ContactPoint>         points;
    std::vector<PointData>            point_data;
    /// See chosen_points(); its memory is kept, because assemblies must not allocate.
    std::vector<unsigned int> listed_points;
    /// How far the faces of each body may move until the next search, and the largest sum of two
    /// of these ways [m].
    std::vector<double> reaches;
    double              reach = 0.;
    /// Time of set_time() [s].
    double time    = 0.;
    bool   is_idle = true;

    Stage   stage   = Stage::created;
    Problem problem = Problem::statics;
    /// Whether dilation is that of the last accepted state, in ContactTimeStep::begin().
    bool slip_is_frozen = false;

    /// Those of the last assembly.
    internal::PointSums sums;
    /// Energy of bonds that broke since the last accepted state [J/m].
    double broken_energy = 0.;
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
        take_point(numbers[i], forces);
      });
  }
} // namespace NMM

#endif
