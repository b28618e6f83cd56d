#ifndef nmm_source_scene_contact_analysis_h
#define nmm_source_scene_contact_analysis_h

#include <nmm/contact/assembly/statics.h>
#include <nmm/contact/assembly/term.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/output/contact_output.h>
#include <nmm/output/progress.h>
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
     * The contact of a scene: its surface, the Contact itself, and the numbers that are reported
     * for each step. All functions are collective.
     *
     * Lifetime: the arguments must outlive this object.
     */
    class ContactAnalysis
    {
    public:
      /// Makes the surface only, since constraints and vectors depend on it. @throws
      /// InputError for obstacles that are wrong.
      ContactAnalysis(const Scene        &scene,
                      const PhysicalMesh &physical_mesh,
                      CoverSystem        &covers);

      /// Makes the contact. @throws InputError for laws that are wrong, and for blocks and
      /// obstacles that overlap.
      void
      make_contact(const dealii::AffineConstraints<double> &constraints,
                   const ElasticityProblem                 &problem);

      Contact &
      contact();

      const Contact &
      contact() const;

      /// Whether closed contact points of the last assembly connect every block with an obstacle.
      /// If there are displacement conditions, which may hold blocks as well, whether there is any
      /// closed point. On several ranks this is not computed, and the result is true.
      bool
      all_are_touched(const ElasticityProblem &problem) const;

      /// The faces that may touch.
      const ContactSurface &
      faces() const;

      /// Largest penetration over all states that were taken [m].
      double
      largest_penetration_so_far() const;

      /// Takes over the largest penetration [m] of an earlier part of the run: before the solid was
      /// cut again, or before the checkpoint from which the run continues.
      void
      continue_from(double earlier_penetration);

      /// A sentence on the faces and the parameters that were chosen, for the report.
      std::string
      description() const;

      /// Warnings for the report: obstacles with the whole solid on the wrong side, corners of blocks
      /// that cannot slide, and faces that cannot bear the initial stress.
      std::vector<std::string>
      notices() const;

      /// The obstacles that are removed at some time.
      const std::vector<ObstacleRelease> &
      releases() const;

      /// Holds or frees the obstacles. While held, they are at their positions of t = 0, and none
      /// is released.
      void
      hold_obstacles(bool are_held);

      /// Makes the contact again without history, with its strength divided by @p factor [-], see
      /// reduce_strength(). Objects that refer to contact() must be destroyed before.
      void
      begin_anew(double factor = 1.);

      /// Stores the present states of the contact points, with which later states are compared to
      /// count changes.
      void
      remember_states();

      /// Stores the last assembly, which must be that of an accepted state, for the functions
      /// below. @p work is the energy that friction, dashpots and breaking bonds have dissipated so
      /// far [J/m].
      void
      take_state(double work);

      /// The data of the state that was taken last.
      struct State
      {
        std::vector<ContactPoint>         points;
        ContactReport                     report;
        std::vector<dealii::Tensor<1, 2>> forces;
        double                            pressure = 0., friction_work = 0.;
      };

      const State &
      last_state() const;

      /// Replaces the state that was taken last by an earlier one.
      void
      show_state(const State &earlier);

      /// Names of the columns of history.csv for numbers().
      std::vector<std::string>
      columns() const;

      /// Numbers of the state that was taken last, with energies and forces times @p thickness.
      std::vector<double>
      numbers(double thickness) const;

      /// The contact points of the state that was taken last, on rank 0.
      std::vector<ContactSample>
      points() const;

      /// The forces between the faces of cracks in the state that was taken last, on rank 0.
      std::vector<ContactForce>
      forces_on_faces() const;

      /// A summary of the state for the progress display, e.g. "12 stick, 3 slip, penetration 1e-6
      /// m".
      std::string
      progress() const;

      /// A message if @p penetration [m] is larger than the scene allows; else empty.
      std::string
      find_deep_penetration(double penetration) const;

      /// The same for the largest penetration of the state that was taken last.
      std::string
      find_deep_penetration() const;

      /// Pressure of a penetration of the size of the rounding error of coordinates [Pa].
      double
      pressure_of_rounding() const;

      /// Adds numbers of the last state to the summary, with energies times the thickness.
      void
      add_to_summary(Summary &summary) const;

    private:
      struct PointState
      {
        unsigned int edge;
        double       s;
        ContactState state;
      };

      /// Whether a part of the solid lies on the right of the obstacle's line, where it is free.
      bool
      is_in_front(unsigned int obstacle) const;

      /// Adds sentences on faces that cannot bear the initial stress.
      void
      add_notices_of_initial_stress(std::vector<std::string> &notices) const;

      /// Number of points on all ranks whose state differs from that of the nearest stored point,
      /// see remember_states().
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
      /// Largest penetration over all states that were taken [m].
      double largest_penetration = 0.;
    };


    /// @p parameters with a sign of life from each iteration, for steps that take long.
    /// @p progress must outlive them.
    NewtonParameters
    show_iterations(NewtonParameters parameters, Progress &progress);


    /// Parameters of Newton's method for static contact, with show_iterations(). Values that the
    /// scene leaves at their defaults are replaced by those for contact.
    NewtonParameters
    contact_newton_parameters(const Scene &scene, Progress &progress);


    /// The term of contact, and one beside it without forces that sums the energy dissipated by
    /// contact and reports each accepted state to a ContactAnalysis.
    class AccountedContact : public ForceTerm
    {
    public:
      AccountedContact(const ModelLayout &layout,
                       ContactAnalysis   &analysis,
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
        analysis->remember_states();
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

      /// A penetration that is larger than the scene allows is a fault.
      StepFault
      find_fault(const Vector &end) override;

      StepWork
      commit(const Trial &step) override;

      void
      save(ByteWriter &archive) const override;

      void
      restore(ByteReader &archive) override;

      /// Continues with the @p history of contact; contact has dissipated @p friction_work so far
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
      ContactTerm      term;
      ContactAnalysis *analysis;
      double           work = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
