#ifndef nmm_source_scene_contact_analysis_h
#define nmm_source_scene_contact_analysis_h

#include <nmm/contact/contact_statics.h>
#include <nmm/dynamics/contact_model.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/output/contact_output.h>
#include <nmm/scene/scene.h>

#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Contact of a scene: its surface and the contact itself, and the numbers that are reported
     * step by step. All functions are collective.
     *
     * Lifetime: the arguments must outlive this object.
     */
    class ContactAnalysis
    {
    public:
      /// Makes the surface only: constraints and vectors come after it. @throws
      /// InputError for obstacles that are wrong.
      ContactAnalysis(const Scene        &scene,
                      const PhysicalMesh &physical_mesh,
                      CoverSystem        &covers);

      /// @throws InputError for laws that are wrong, blocks and obstacles
      /// that overlap.
      void
      make_contact(const dealii::AffineConstraints<double> &constraints,
                   const ElasticityProblem                 &problem);

      Contact &
      contact();

      const Contact &
      contact() const;

      /// Do faces that press in the last assembly of the contact connect every block with an
      /// obstacle? With displacement conditions, which may hold blocks as well: does any face
      /// press? On several ranks it is not found out, and said to be so.
      bool
      all_are_touched(const ElasticityProblem &problem) const;

      /// What was chosen, for people.
      std::string
      description() const;

      /// Obstacles that have the whole solid behind them, for people.
      std::vector<std::string>
      notices() const;

      /// Obstacles that are gone from some time on.
      const std::vector<ObstacleRelease> &
      releases() const;

      /// While held, obstacles are where they are at t = 0, and none is released.
      void
      hold_obstacles(bool are_held);

      /// Contact anew, without history, its strength divided by @p factor, see
      /// reduce_strength(). Whoever refers to contact() has to go first.
      void
      begin_anew(double factor = 1.);

      /// Changes are counted from the present states on.
      void
      remember_states();

      /// Keep the last assembly, that of an accepted state, which the functions below report.
      /// @p work: what friction, dashpots and breaking bonds have dissipated so far [J/m].
      void
      take_state(double work);

      /// What is reported of the state that was taken last.
      struct State
      {
        std::vector<ContactPoint>         points;
        ContactReport                     report;
        std::vector<dealii::Tensor<1, 2>> forces;
        double                            pressure = 0., friction_work = 0.;
      };

      const State &
      last_state() const;

      /// Tell of an earlier state.
      void
      show_state(const State &earlier);

      /// Names of the numbers of a state.
      std::vector<std::string>
      columns() const;

      /// Energies and forces times @p thickness.
      std::vector<double>
      numbers(double thickness) const;

      /// On the first rank.
      std::vector<ContactSample>
      points() const;

      /// What the faces of cracks exert on each other in the state that was taken last; on the
      /// first rank.
      std::vector<ContactForce>
      forces_on_faces() const;

      /// "12 stick, 3 slip, penetration 1e-6 m".
      std::string
      progress() const;

      /// Words for a penetration that is deeper than the scene allows; else empty.
      std::string
      find_deep_penetration(double penetration) const;

      /// Of the last state that was taken.
      std::string
      find_deep_penetration() const;

      /// Pressure of a penetration that is rounding of coordinates [Pa].
      double
      pressure_of_rounding() const;

      /// Numbers of the last state into the summary, energies times the thickness.
      void
      add_to_summary(Summary &summary) const;

    private:
      struct PointState
      {
        unsigned int edge;
        double       s;
        ContactState state;
      };

      /// Does a part of the solid lie on the right of the obstacle's line?
      bool
      is_in_front(unsigned int obstacle) const;

      /// Points of all ranks whose state is not that of the nearest remembered one.
      unsigned int
      count_changes() const;

      const Scene                             *scene;
      ObstacleSwitches                         switches;
      const CoverSystem                       *covers;
      std::unique_ptr<ContactSurface>          surface;
      std::unique_ptr<Contact>                 contact_pointer;
      double                                   cell_size   = 0.;
      const dealii::AffineConstraints<double> *constraints = nullptr;
      ContactParameters                        full_strength;
      std::vector<PointState>                  remembered;
      State                                    state;
      /// Of all states [m].
      double largest_penetration = 0.;
    };


    /// Newton's method for static contact: what the scene leaves at its default is
    /// chosen for contact.
    NewtonParameters
    contact_newton_parameters(const Scene &scene);


    /// A contact model that keeps account of friction and tells which states change.
    class AccountedContactModel : public ContactModel
    {
    public:
      AccountedContactModel(MechanicalModel &model, ContactAnalysis &analysis);

      void
      begin_step(const Vector &begin,
                 const Vector &predicted,
                 double        t,
                 double        h) override;

      /// As in ContactModel; and faces may not be deeper in each other than the scene
      /// allows.
      StepFault
      find_fault(const Vector &end) override;

      double
      accept_step(const Vector &end, double t) override;

      std::vector<char>
      internal_state() const override;

      void
      restore_internal_state(const std::vector<char> &state) override;

      /// What friction, dashpots and breaking bonds have dissipated so far [J/m].
      double
      friction_work() const;

    private:
      ContactAnalysis *analysis;
      double           work = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
