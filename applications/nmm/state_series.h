#ifndef nmm_applications_state_series_h
#define nmm_applications_state_series_h

#include <nmm/covers/cover_system.h>
#include <nmm/io/field_samples.h>
#include <nmm/io/output_directory.h>
#include <nmm/io/scene.h>

#include <string>
#include <utility>
#include <vector>

/// Draw picture.png or one of a series, as the scene says; without @p evaluator
/// which block is which. Collective.
void
write_picture(const NMM::Scene           &scene,
              const NMM::CoverSystem     &covers,
              const NMM::FieldTriangles  &triangles,
              const NMM::FieldEvaluator  *evaluator,
              const std::string          &title,
              const std::string          &file_name,
              const NMM::OutputDirectory &directory);

/**
 * Fields and pictures of states of a run, written as they come: fields-NNNN.vtu,
 * picture-NNNN.png, and fields.pvd, which at any time lists the fields that are
 * there. All functions are collective.
 *
 * Lifetime: the arguments of the constructor must outlive this object.
 */
class StateSeries
{
public:
  StateSeries(const NMM::Scene           &scene,
              const NMM::CoverSystem     &covers,
              const NMM::OutputDirectory &directory);

  /// Keep the fields of an earlier run up to the state @p last (time or load
  /// factor).
  void
  resume(double last);

  /// State @p number at @p value (time or load factor), which
  /// @p description tells in the picture's title.
  void
  write(unsigned int               number,
        double                     value,
        const std::string         &description,
        const NMM::FieldEvaluator &evaluator);

  /// The fields of the last state are in @p file_name.
  void
  finish(double value, const std::string &file_name);

private:
  void
  write_list() const;

  const NMM::Scene                           *scene;
  const NMM::CoverSystem                     *covers;
  const NMM::OutputDirectory                 *directory;
  std::vector<std::pair<double, std::string>> files;
};

#endif
