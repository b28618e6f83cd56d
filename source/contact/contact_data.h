#ifndef nmm_source_contact_contact_data_h
#define nmm_source_contact_contact_data_h

#include <nmm/contact/contact.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <contact/active_bodies.h>
#include <contact/contact_crossings.h>
#include <contact/contact_matrix.h>
#include <contact/contact_memory.h>
#include <contact/contact_points.h>
#include <contact/contact_search.h>
#include <contact/contact_terms.h>
#include <contact/step_clearances.h>
#include <initializer_list>
#include <memory>
#include <vector>

namespace NMM
{
  struct Contact::Data
  {
    Data(ContactSurface                          &surface,
         const dealii::AffineConstraints<double> &constraints,
         const ContactParameters                 &parameters);

    /// What has been done, see Contact.
    enum class Stage
    {
      created,
      detected,
      assembled,
      step_begun,
      /// assemble_between() has been called: an assembly is one of the step, or of its end.
      step_assembled,
      accepted,
      /// The end of a step of assemble_between() has been accepted.
      step_accepted
    };

    enum class Problem
    {
      statics,
      /// See Contact::freeze_geometry().
      statics_of_frozen_geometry,
      /// A time step has begun.
      motion,
      /// A time step that conserves energy has been tried.
      conserving_motion
    };

    /// @p next is reached from one of the stages @p from.
    void
    enter(const Stage next, const std::initializer_list<Stage> from)
    {
      Assert(
        std::find(from.begin(), from.end(), stage) != from.end(),
        dealii::ExcMessage(
          "Functions of Contact have been called in another order than its "
          "documentation says."));
      (void)from;
      stage = next;
    }

    /// Whether points are those of a step of assemble_between(), or of its end.
    bool
    is_between() const
    {
      return stage == Stage::step_assembled || stage == Stage::step_accepted;
    }

    bool
    is_moving() const
    {
      return problem == Problem::motion ||
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
      return problem == Problem::statics_of_frozen_geometry;
    }

    /// Opening of a point by slip [m], and the derivatives of gap minus opening
    /// by the gap and by the distance along the face from where it sticks [-].
    struct Dilation
    {
      double opening = 0., by_gap = 1., by_slip = 0.;
    };

    /// What does not change from one assembly to the next.
    struct alignas(64) PointData
    {
      /// Position in ContactSearch::slaves().
      unsigned int slave;
      /// See PointKind.
      unsigned int corner = internal::PointKind::along;
      /// Place on the slave, which is that of the point unless it is a corner of the
      /// master.
      double s = 0.;
      /// Of the slave between two divisions [m].
      double                       piece_length = 0.;
      ContactSurface::WeightValues weights;
      /// That of the last master.
      const ContactLaw *law = nullptr;
      /// See ContactSearch::end_slack().
      double slack = 0.;
      /// The master whose end it is for which there is slack.
      unsigned int home = invalid_index;
      /// The weight knows the angle between both faces, that of the first time
      /// there is a master since detect().
      bool has_angle = false;
      /// Of a time step: gaps [m] at its ends, shear at its start [Pa], what the
      /// shear has done and what the dashpot has taken [J/m].
      double gap_begin = 0., gap_end = 0., shear_begin = 0., shear_work = 0.,
             normal_loss = 0.;
      /// Gap at which the spring is at rest [m], see Contact::begin_step(), and
      /// the same at the end of the step, where it is another one if the master has
      /// changed to a face that is not the continuation of the first.
      double offset = 0., offset_end = 0.;
      /// Masters at both ends of the step; invalid_index: none.
      unsigned int master_begin = invalid_index, master_end = invalid_index;
      /// Where on the master at the end, and its normal there.
      double               t_end = 0.;
      dealii::Tensor<1, 2> normal_end;
      /// Derivatives of the pressure in a step, times the weight, by the gap at the
      /// end and by how far both faces open [N/m^2].
      double pressure_by_gap = 0., pressure_by_opening = 0.;
      /// Slip that has dilated at the last accepted state and since then [m].
      double slip = 0., new_slip = 0.;
      /// At the end of a time step.
      Dilation dilation;
      /// Of faces_beside.
      unsigned int beside_begin = 0, beside_end = 0;
    };

    void
    make_points();

    void
    find_faces_beside();

    void
    add_points_of(unsigned int slave);

    void
    add_corner(unsigned int slave);

    ContactSurface::WeightValues
    weights_at(const ContactPoint &point) const;

    /// History of a point: where it stuck, its multiplier on @p slave.
    void
    restore(ContactPoint &point, PointData &fixed, unsigned int slave) const;

    void
    take_over_place(ContactPoint &point,
                    PointData    &fixed,
                    unsigned int  slave) const;

    /// All faces move to where @p u (locally relevant) puts them.
    void
    move_to(const Vector &u);

    /// The state at the end of a step is that of @p end in the active bodies, and the
    /// one in its middle is the mean of both ends.
    void
    set_step_states(const Vector &end);

    /// Faces of active bodies that have moved since the last assembly are where the
    /// displacements at the step's end and in its middle put them. The surface is at the end.
    void
    update_faces();

    /// Faces of active bodies are where Contact::expect() says.
    void
    move_as_expected();

    /// What may touch in the step comes into the pattern, faces being where its first
    /// assembly, or Contact::expect(), has them at its end: that depends on the state at the
    /// step's begin alone, so that a continuation has the same pattern.
    void
    couple_expected();

    /// See Contact::freeze_geometry(): the same in every assembly since detect(), but for the
    /// gap, which is that of the displacements.
    internal::ContactProjection
    project_frozen(unsigned int q, const ContactSurface::Place &slave);

    /// The nearest master of a point at the current positions; notes weight and
    /// place of sticking when there is one for the first time.
    internal::ContactProjection
    project(unsigned int q, const ContactSurface::Place &slave);

    /// Where a face ends in a concave corner and a corner of a body is beyond that: the face
    /// that begins there. If the body lies along the first one, its corner has no share
    /// in that, and all of it in the second one, however steep its face is on that.
    unsigned int
    face_beyond_concave_end(
      const internal::ContactProjection &projection) const;

    /// A corner that is in contact at one end of a step only is so by the face of that
    /// end: at a corner of the master, which face is nearer in the middle jumps, and
    /// with it the force.
    void
    stay_with_face_of_end(unsigned int                 q,
                          const ContactSurface::Place &slave,
                          internal::ContactProjection &projection) const;

    /// Does one of the edges go on in the other, within a few edges?
    bool
    goes_on(unsigned int edge,
            unsigned int other,
            unsigned int n_edges = 4) const;

    /// New contact may be as deep as faces have moved since the begin of the step,
    /// at first since the reference configuration, in which blocks do not overlap; in
    /// steps that conserve energy as deep as it likes.
    void
    set_admitted_depth();

    void
    note_touching();

    /// Of two edges.
    void
    note_touching(unsigned int edge, unsigned int master);

    internal::AdmittedContact
    find_admitted(unsigned int q) const;

    /**
     * Statics: the gap of a projection, with X for places in the reference configuration
     * and N for the normal there,
     * @f[ g = (u_s - u_m)\cdot n + (X_s - X_m)\cdot(n - N) + (X_s - X_m)\cdot N, @f]
     * which is that of the positions. But its digits are those of the displacements: stiff
     * springs under small loads give way by less than what positions are rounded to. The
     * last term is 0 where faces are drawn as touching, so that they do, whatever the load.
     */
    double
    gap_of_displacements(unsigned int                       q,
                         const internal::ContactProjection &projection) const;

    /// From where a point sticks to where it is [m]; in statics in the same way.
    dealii::Tensor<1, 2>
    way_from_stick(unsigned int q, const ContactSurface::Place &slave) const;

    /// As ContactSearch finds it for a point along an edge, or a corner.
    internal::ContactProjection
    find_master(unsigned int q, const ContactSurface::Place &slave) const;

    /// Candidates of a point.
    dealii::ArrayView<const unsigned int>
    masters_of(unsigned int q) const;

    /// At the begin of a step: how far points are from touching.
    void
    find_clearances();

    /// A point touches neither at the end of the step nor at its begin.
    void
    note_clear(unsigned int q);

    /// @name One point in an assembly
    /// @{
    void
    assemble_point(unsigned int                       q,
                   const internal::ContactProjection &projection,
                   const internal::ContactTraction   &traction,
                   bool                               with_tangent);

    /// Slaves of contact points.
    std::vector<unsigned int>
    slaves_of(const std::vector<unsigned int> &numbers) const;

    /// Of all active points: which are near.
    void
    find_ends();

    /// Where a point is at the end of a step; false, and open, if it touches neither there
    /// nor at the begin.
    bool
    find_end(unsigned int q);

    void
    add_point_between(unsigned int q, bool with_tangent);

    /// Of the slave against the master in the step [m].
    dealii::Tensor<1, 2>
    relative_motion(unsigned int                       q,
                    const internal::ContactProjection &projection) const;

    /// Springs and dashpot of a point in a step, and the loss.
    void
    find_pressure_between(unsigned int               q,
                          double                     opening,
                          internal::ContactTraction &traction);

    /// Derivatives by the displacements of slave and master in the middle of the step:
    /// of that pressure, times the weight, and of half of the slip.
    void
    differentiate_step(unsigned int                       q,
                       const internal::ContactProjection &projection,
                       const internal::ContactKinematics &kinematics,
                       double                            *pressure_change,
                       double *half_slip_change) const;

    /// Unit normal of the edge that meets the one of a corner there; zero if none
    /// does.
    dealii::Tensor<1, 2>
    normal_of_other_edge(unsigned int q) const;

    /// Share of the contact with a face of this normal that a point has, see
    /// ContactSearch.
    double
    share(unsigned int                q,
          const dealii::Tensor<1, 2> &slave_normal,
          const dealii::Tensor<1, 2> &master_normal) const;

    /// Opening at the current positions: since the last accepted state a point
    /// slides as far as its strength does not hold it, an open one without strength;
    /// notes the slip.
    Dilation
    find_dilation(unsigned int                       q,
                  const ContactSurface::Place       &slave,
                  const internal::ContactProjection &projection);

    /// Opening by what had slid at the last accepted state [m].
    double
    opening_before(const unsigned int q) const
    {
      const ContactLaw *law = point_data[q].law;
      return law == nullptr ? 0. : law->opening(point_data[q].slip);
    }

    /// Of any point of any rank at the last accepted state, or more [m].
    double
    largest_opening() const;

    /// Shear: @p trial, not more than the pressure allows; decides between stick and slip.
    /// @p stiffness: derivative of the trial [Pa/m].
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

    void
    add_point(unsigned int q, bool with_tangent);

    internal::ContactTraction
    find_traction(unsigned int                       q,
                  const ContactSurface::Place       &slave,
                  const internal::ContactProjection &projection);

    /// Stress over strength of a bond; negative if there is none.
    double
    bond_ratio(unsigned int q) const;
    /// @}

    double
    accept_shear(unsigned int q);

    /// Call action(q) for points that an active body has part in, ascending.
    template <typename Action>
    void
    for_each_active_point(const Action &action)
    {
      active.for_each_point(points.size(), action);
    }

    /// If there are inactive bodies: which points belong to which body.
    void
    list_points_of_bodies();

    /// Does the step that began at detect() take anything through something else to where
    /// the surface is now? @p largest_motion: of any point of a face in the step [m].
    StepFault
    find_crossing(double largest_motion);

    void
    reduce_report();

    /// What the normal spring of a point stores under a pressure, and what the shear spring
    /// does under a shear [J/m].
    double
    normal_energy(const unsigned int q, const double pressure) const
    {
      const ContactLaw &law = *point_data[q].law;
      return points[q].weight * law.energy(law.penetration(pressure));
    }

    double
    shear_energy(const unsigned int q, const double shear) const
    {
      return points[q].weight * point_data[q].law->shear_energy(shear);
    }

    /// Of a cell at the slave of a point, or of the face if that is shorter [m].
    double
    size_at(const unsigned int q) const
    {
      return corner_size[2 * search.slaves()[point_data[q].slave]];
    }

    /// Penetrations and shears are multiplied by @p factors of their pair, if there are any.
    internal::PairEnergies
    pair_energies(const internal::PairEnergies *factors = nullptr) const;

    std::pair<unsigned int, unsigned int>
    bodies(unsigned int q) const;

    internal::PairEnergies
    factors_that_keep_energies(const internal::PairEnergies &found) const;

    void
    keep_energies();

    /// What assemblies of a time step need, from begin_step() to accept().
    struct Step
    {
      /// Displacements at the begin of the step, where detect() was called, and when [s].
      std::vector<double> nodal_begin;
      double              time_detected = 0.;
      /// When begin_step() was called [s], and from there to the end [s].
      double time_begin = 0., length = 0.;
      /// Faces at the end of the step and in its middle, and the way of obstacles [m].
      ContactSurface::State             end, middle;
      std::vector<dealii::Tensor<1, 2>> obstacle_changes;
      /// See Contact::expect(); empty: nothing is expected.
      std::vector<double> nodal_expected;
      /// Which points cannot touch anything in the step, and whether a point was clear in the
      /// last assembly.
      internal::StepClearances clearances;
      std::vector<bool>        was_clear;
      /// Active points that touch at the begin or the end of the step.
      std::vector<unsigned int> near_points;
      /// Energy that is lost between the last accepted state and the begin of the step [J/m].
      double detection_loss = 0.;
    };

    /// See Contact::freeze_geometry(). By point: its projection at the first assembly since
    /// detect(), and by how much its gap is more than that of the displacements [m].
    struct FrozenGeometry
    {
      std::vector<internal::ContactProjection> projections;
      std::vector<double>                      gaps;
      std::vector<bool>                        is_known;
    };

    ContactSurface         *surface;
    ContactParameters       parameters;
    MPI_Comm                communicator;
    internal::ContactSearch search;
    internal::ContactLaws   laws;
    bool                    has_friction;
    /// See corner_sizes().
    std::vector<double> corner_size;
    std::vector<double> rule_points, rule_weights;
    /// Augmented Lagrangian only.
    std::unique_ptr<internal::MultiplierSpace> multiplier_space;

    internal::ContactMemory memory;
    internal::ActiveBodies  active;
    internal::ContactMatrix matrix;
    Step                    step;
    FrozenGeometry          frozen;
    /// Null: not needed so far.
    std::unique_ptr<internal::ContactCrossings> crossings;

    std::vector<double>       nodal;
    std::vector<ContactPoint> points;
    std::vector<PointData>    point_data;
    /// See ContactSearch::append_faces_beside(): where points were made, and as long as
    /// they are, so that no step has to find out while it goes.
    std::vector<unsigned int> faces_beside;
    /// How far faces were looked for last, and how deep new contact may be, see
    /// AdmittedContact [m].
    double reach = 0., admitted_depth = 0.;
    /// That is set [s].
    double time    = 0.;
    bool   is_idle = true;

    Stage   stage   = Stage::created;
    Problem problem = Problem::statics;
    /// What has slid at the last accepted state is all that opens faces.
    bool slip_is_frozen = false;

    /// Of the last assembly; the largest penetration of springs, without offsets [m].
    ContactReport                report;
    double                       deepest = 0.;
    internal::ContactLocalSystem local;
    /// By bonds that broke since the last accepted state [J/m].
    double broken_energy = 0.;
  };
} // namespace NMM

#endif
