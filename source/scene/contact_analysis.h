#ifndef nmm_source_scene_contact_analysis_h
#define nmm_source_scene_contact_analysis_h

#include <nmm/analysis/contact_model.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/output/contact_output.h>
#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>
#include <nmm/solution/newton_solver.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The contact of a scene, and what is reported of it. All functions are collective.
    class ContactAnalysis : public ContactModel
    {
    public:
      /// The arguments must outlive this object. @throws InputError as the constructor of ContactModel.
      ContactAnalysis(const Scene             &scene,
                      const Solid             &solid,
                      const ElasticityProblem &problem);

      /// A sentence on the faces and the parameters that were chosen, for the report.
      std::string
      description() const;

      /// Warnings for the report: obstacles with the whole solid on the wrong side, corners of blocks
      /// that cannot slide, and faces that cannot bear the initial stress.
      std::vector<std::string>
      notices() const;

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

      /// Pressure of a penetration of the size of the rounding error of coordinates [Pa].
      double
      pressure_of_rounding() const;

      /// Adds numbers of the last state to the summary, with energies times the thickness.
      void
      add_to_summary(Summary &summary) const;

    private:
      /// Whether a part of the solid lies on the right of the obstacle's line, where it is free.
      bool
      is_in_front(unsigned int obstacle) const;

      /// Adds sentences on faces that cannot bear the initial stress.
      void
      add_notices_of_initial_stress(std::vector<std::string> &notices) const;

      const Scene *scene;
      const Solid *solid;
    };


    /// @p parameters with a sign of life from each iteration, for steps that take long.
    /// @p progress must outlive them.
    NewtonParameters
    show_iterations(NewtonParameters parameters, Progress &progress);
  } // namespace internal
} // namespace NMM

#endif
