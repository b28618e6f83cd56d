#ifndef nmm_analysis_contact_model_h
#define nmm_analysis_contact_model_h

#include <nmm/contact/assembly/term.h>
#include <nmm/contact/chosen_parameters.h>
#include <nmm/contact/contact.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/solid.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// What contact needs to be told beside the solid.
  struct ContactSetup
  {
    /// Rigid bodies that the solid can touch.
    std::vector<RigidObstacle> obstacles;
    /// Those that are removed at some time, by their indices.
    std::vector<ObstacleRelease> releases;
    /// Laws and search; what they leave open is chosen for the solid.
    ContactChoices choices;
    /// Makes all parameters instead; null: choose_contact_parameters() does.
    std::function<ContactParameters(const ContactSurface &,
                                    const ElasticityProblem &)>
      make_parameters;
    /// Largest penetration of an accepted state [m]; 0: contact_cell_size().
    double max_penetration = 0.;
    /// The unit of lengths in messages.
    std::string length_unit = "m";
  };


  /**
   * The contact of a solid with itself and with obstacles: the surface, the Contact, and an account of
   * accepted states. All functions are collective.
   *
   * Lifetime: the solid must outlive this object.
   */
  class ContactModel
  {
  public:
    /// @throws InputError for obstacles and laws that are wrong, for a reach of more than ten times the
    /// size of the solid, and for blocks and obstacles that overlap.
    ContactModel(const Solid             &solid,
                 const ElasticityProblem &problem,
                 ContactSetup             setup);

    virtual ~ContactModel() = default;

    /// @{
    /// Forces between the faces.
    Contact &
    contact()
    {
      return *law;
    }
    const Contact &
    contact() const
    {
      return *law;
    }
    /// @}

    /// The faces that may touch.
    const ContactSurface &
    faces() const
    {
      return *surface;
    }

    /// The obstacles that are removed at some time.
    const std::vector<ObstacleRelease> &
    releases() const
    {
      return setup.releases;
    }

    /// contact_cell_size() of the faces [m].
    double
    cell_size() const
    {
      return size_of_cells;
    }

    /// The parameters with the full strength of faces.
    const ContactParameters &
    full_strength() const
    {
      return parameters;
    }

    /// Hold or free the obstacles. While held, they are at their positions of t = 0, and none
    /// is removed.
    void
    hold_obstacles(bool are_held);

    /// Make the contact again without history, with its strength divided by @p factor [-], see
    /// reduce_strength(). Objects that refer to contact() must be destroyed before.
    void
    begin_anew(double factor = 1.);

    /// Whether closed contact points of the last assembly connect every block with an obstacle.
    /// If @p problem has displacement conditions or fixed points, which may hold blocks as well, whether
    /// there is any closed point. On several ranks this is not computed, and the result is true.
    bool
    all_are_touched(const ElasticityProblem &problem) const;

    /// Store the present states of the contact points, with which later states are compared to
    /// count changes.
    void
    remember_states();

    /// The data of an accepted state.
    struct State
    {
      /// This rank's contact points.
      std::vector<ContactPoint> points;
      /// Counts, largest penetration [m] and energy [J/m].
      ContactReport report;
      /// Force of the solid on each obstacle [N/m].
      std::vector<dealii::Tensor<1, 2>> forces;
      /// Largest pressure [Pa], and energy that friction, dashpots and breaking bonds have dissipated
      /// so far [J/m].
      double pressure = 0., friction_work = 0.;
    };

    /// Store the last assembly, which must be that of an accepted state, as last_state(). @p work is
    /// State::friction_work.
    void
    take_state(double work);

    /// The state that was taken last.
    const State &
    last_state() const
    {
      return state;
    }

    /// Replace the state that was taken last by an earlier one.
    void
    show_state(const State &earlier)
    {
      state = earlier;
    }

    /// Largest penetration over all states that were taken [m].
    double
    largest_penetration_so_far() const
    {
      return largest_penetration;
    }

    /// Take over the largest penetration [m] of an earlier part of the run: before the solid was
    /// cut again, or before the checkpoint from which the run continues.
    void
    continue_from(double earlier_penetration);

    /// A part of a message if @p penetration [m] is larger than an accepted one may be; else empty.
    std::string
    find_deep_penetration(double penetration) const;

  private:
    struct PointState
    {
      unsigned int edge;
      double       s;
      ContactState state;
    };

    /// Number of points on all ranks whose state differs from that of the nearest stored point,
    /// see remember_states().
    unsigned int
    count_changes() const;

    const Solid                    *solid;
    ContactSetup                    setup;
    std::shared_ptr<bool>           is_frozen;
    std::unique_ptr<ContactSurface> surface;
    double                          size_of_cells;
    ContactParameters               parameters;
    std::unique_ptr<Contact>        law;
    std::vector<PointState>         remembered;
    State                           state;
    double                          largest_penetration = 0.;
  };


  /// The term of contact, and one beside it without forces that sums the energy dissipated by
  /// contact, refuses deep penetrations, and lets a ContactModel take each accepted state.
  class AccountedContact : public ForceTerm
  {
  public:
    /// The arguments must outlive this object.
    AccountedContact(const ModelLayout &layout,
                     ContactModel      &model,
                     ContactUpdate      update);

    /// Append both to the terms of a MechanicalModel.
    void
    append_to(std::vector<ForceTerm *> &terms)
    {
      terms.insert(terms.end(), {&term, this});
    }

    void
    begin_step(const StepBegin &) override
    {
      model->remember_states();
    }

    Deformation
    assemble(const Trial &, AssembledForces &) override
    {
      return Deformation::admissible;
    }

    ForceProperties
    properties() const override
    {
      return {};
    }

    /// A penetration that is larger than ContactSetup::max_penetration is a fault.
    StepFault
    find_fault(const Vector &end) override;

    StepWork
    commit(const Trial &step) override;

    void
    save(ByteWriter &archive) const override;

    void
    restore(ByteReader &archive) override;

    /// Continue with the @p history of contact; contact has dissipated @p friction_work so far
    /// [J/m].
    void
    continue_from(const ContactHistory &history, double friction_work = 0.);

    /// Energy that friction, dashpots and breaking bonds have dissipated so far [J/m].
    double
    friction_work() const
    {
      return work;
    }

  private:
    ContactTerm   term;
    ContactModel *model;
    double        work = 0.;
  };
} // namespace NMM

#endif
