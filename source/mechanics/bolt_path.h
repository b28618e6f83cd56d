#ifndef nmm_source_mechanics_bolt_path_h
#define nmm_source_mechanics_bolt_path_h

#include <nmm/covers/manifold_mesh.h>

#include <mechanics/bolt_bar.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// A straight part of a bolt's path that is all in rock of one side of joints, or in no rock.
    struct BoltStretch
    {
      /// Arc length from the head [m].
      double begin = 0., end = 0.;
      /// @{
      /// Ends in the reference configuration. Where the rock ends or a joint is crossed they lie a
      /// millionth of the stretch inside, so that the side is certain [m].
      dealii::Point<2> first, last;
      /// @}
      bool is_in_rock = true;
      /// Whether it continues the rock of the stretch before.
      bool continues = false;
      /// Whether a joint lies between it and the stretch before, which is in rock, and its name.
      bool        crosses = false;
      std::string joint;
    };


    /// Cuts the path of a bolt at its corners, at curves where the displacement may jump, at the
    /// ends of the rock, and at the arc lengths @p further [m].
    /// @throws InputError that begins with @p what for a path without length, or whose ends are
    /// outside the rock.
    std::vector<BoltStretch>
    cut_bolt_path(const ManifoldMesh                  &mesh,
                  const std::vector<dealii::Point<2>> &path,
                  const std::vector<double>           &further,
                  const std::string                   &what);


    /// Elements of a stretch. With a fifth of the length over which forces decay, the error of the
    /// pull-out force is below 1e-4. A bar that may break has elements of its gauge length. A bonded
    /// bar yields where the force is largest, in one point: at such an end there is a short element,
    /// along which the force hardly changes.
    std::vector<BoltBar::Element>
    make_elements(const BoltStretch &stretch,
                  const BarSection  &section,
                  bool               is_bonded,
                  bool               may_yield_first,
                  bool               may_yield_last);
  } // namespace internal
} // namespace NMM

#endif
