#include <nmm/output/picture.h>
#include <nmm/output/vtu.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <scene/state_series.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      bool
      is_first_rank(const CoverSystem &covers)
      {
        return dealii::Utilities::MPI::this_mpi_process(
                 covers.communicator()) == 0;
      }


      /// Whether displacements are drawn without scaling, unless the scene gives a factor. Small
      /// ones would not be seen then.
      bool
      shows_true_size(const Scene &scene)
      {
        return scene.parameters().model.kinematics != Kinematics::small;
      }
    } // namespace


    StateSeries::StateSeries(const Scene           &scene,
                             const CoverSystem     &covers,
                             const ContactAnalysis *contact,
                             const OutputDirectory &directory)
      : scene(&scene)
      , covers(&covers)
      , contact(contact)
      , directory(&directory)
      , files(directory, "fields")
    {
      const SceneParameters &parameters = scene.parameters();
      if (contact != nullptr && is_first_rank(covers))
        contact_series = std::make_unique<ContactSeries>(
          contact->contact().surface(),
          directory,
          parameters.model.analysis != Analysis::statics ? "time"
          : parameters.fracture.n_increments > 0 ||
              !parameters.load_steps.load_steps().are_ascending()
            ? "step"
            : "load_factor",
          parameters.output.contacts,
          parameters.output.fields);
      if (parameters.fracture.intensity_factors && parameters.output.fields &&
          is_first_rank(covers))
        tip_files = std::make_unique<FileSeries>(directory, "tips");
    }


    void
    StateSeries::follow(const CoverSystem     &new_covers,
                        const ContactAnalysis *new_contact)
    {
      AssertThrow((contact == nullptr) == (new_contact == nullptr),
                  dealii::ExcInternalError());
      covers  = &new_covers;
      contact = new_contact;
      if (contact_series)
        contact_series->follow(contact->contact().surface());
    }


    void
    StateSeries::resume(const double last)
    {
      if (!is_first_rank(*covers))
        return;
      const double limit = last + 1e-9 * std::abs(last);
      files.resume(limit);
      if (contact_series)
        contact_series->resume(limit);
      if (tip_files)
        tip_files->resume(limit);
      const OutputParameters &output = scene->parameters().output;
      if (output.animation && output.picture && output.fields_every > 0)
        open_animation(limit);
    }


    void
    StateSeries::write(const unsigned int    number,
                       const double          value,
                       const std::string    &description,
                       const FieldEvaluator &evaluator,
                       const CrackSample    *cracks)
    {
      const OutputParameters &output = scene->parameters().output;
      std::ostringstream      suffix;
      suffix << '-' << std::setw(4) << std::setfill('0') << number;
      const FieldTriangles triangles(*covers, &evaluator);
      if (output.fields)
      {
        const std::string name = write_fields_of_state(*covers,
                                                       triangles,
                                                       *directory,
                                                       "fields" + suffix.str());
        // Wait until the files of all ranks exist, before the list names them.
        MPI_Barrier(covers->communicator());
        if (is_first_rank(*covers))
          files.add(value, name);
      }
      if (contact != nullptr)
      {
        const auto points = contact->points();
        if (contact_series)
          contact_series->write(value, "contacts" + suffix.str(), points);
      }
      if (cracks != nullptr && tip_files)
      {
        const std::string name = "tips" + suffix.str() + ".vtu";
        write_tips(cracks->tips, *directory, name);
        tip_files->add(value, name);
      }
      if (!output.picture)
        return;
      const PictureData data = draw(cracks,
                                    triangles,
                                    &evaluator,
                                    scene->title() + ", " + description,
                                    "picture" + suffix.str() + ".png");
      if (output.animation && is_first_rank(*covers))
      {
        if (animation == nullptr)
          open_animation(-std::numeric_limits<double>::infinity());
        animation->add_frame(value, data);
      }
    }


    PictureData
    StateSeries::draw(const CrackSample    *cracks,
                      const FieldTriangles &triangles,
                      const FieldEvaluator *evaluator,
                      const std::string    &title,
                      const std::string    &file_name) const
    {
      OutputParameters parameters = scene->parameters().output;
      if (evaluator == nullptr)
        parameters.quantity = Quantity::block;
      if (shows_true_size(*scene) && parameters.deformation_scale < 0.)
        parameters.deformation_scale = 1.;
      parameters.material_names =
        covers->manifold_mesh().physical_mesh().material_names();
      PictureData data =
        make_picture_data(*covers, triangles, evaluator, parameters);
      if (contact != nullptr && evaluator != nullptr)
        add_contact(contact->contact().surface(),
                    contact->points(),
                    data,
                    contact->pressure_of_rounding());
      if (bolts != nullptr && evaluator != nullptr)
        bolts->add_to(data);
      if (cracks != nullptr)
        add_cracks(*cracks, data);
      if (is_first_rank(*covers))
        directory->write_file(file_name, [&](const std::string &name) {
          draw_picture(data, parameters, title, name);
        });
      return data;
    }


    void
    StateSeries::open_animation(const double last)
    {
      animation =
        std::make_unique<Animation>(directory->file("animation.frames"), last);
    }


    void
    StateSeries::write_animation(const double value, const PictureData *last)
    {
      if (animation == nullptr || animation->n_frames() == 0)
        return;
      OutputParameters output = scene->parameters().output;
      const bool       is_dynamic =
        scene->parameters().model.analysis != Analysis::statics;
      AnimationParameters parameters;
      parameters.time_name = is_dynamic ? "t"
                             : scene->parameters().fracture.n_increments > 0
                               ? "increment"
                               : "load factor";
      parameters.time_unit = is_dynamic ? "s" : "";
      parameters.smallest_hole =
        smallest_hole(covers->manifold_mesh().physical_mesh());
      output.material_names =
        covers->manifold_mesh().physical_mesh().material_names();
      if (shows_true_size(*scene) && output.deformation_scale < 0.)
        output.deformation_scale = 1.;
      // The final state is a further frame that is not stored, since a run that continues this one
      // does not have it in its series. An empty picture is left out.
      if (last != nullptr && last->triangles.empty())
        last = nullptr;
      directory->write_text("animation.html", [&](std::ostream &out) {
        animation->write(
          out, scene->title(), output, parameters, {value, last});
      });
    }


    void
    StateSeries::finish(const double       value,
                        const std::string &file_name,
                        const CrackSample *cracks)
    {
      MPI_Barrier(covers->communicator());
      if (is_first_rank(*covers))
        files.finish(value, file_name);
      if (cracks != nullptr && tip_files)
      {
        write_tips(cracks->tips, *directory, "tips.vtu");
        tip_files->finish(value, "tips.vtu");
      }
    }


    void
    StateSeries::finish_contact(const double value)
    {
      if (contact == nullptr)
        return;
      const auto points = contact->points();
      if (contact_series)
        contact_series->finish(value, points);
    }
  } // namespace internal
} // namespace NMM
