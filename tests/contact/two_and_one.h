#ifndef nmm_tests_contact_two_and_one_h
#define nmm_tests_contact_two_and_one_h

#include <nmm/contact/assembly/time_step.h>

#include <contact/contact_model.h>
#include <memory>
#include <support/coulomb.h>

namespace NMM
{
  namespace Test
  {
    inline Bodies::Options
    one_triangle_each()
    {
      Bodies::Options options;
      options.cell_size           = 10.;
      options.mesh_of_every_block = true;
      return options;
    }


    /// A block above another one, and a third one beside that is only looked for.
    class TwoAndOne : public testing::Test
    {
    protected:
      static constexpr double gap = 0.01, reach = 0.1, h = 0.01;

      TwoAndOne()
      {
        Geometry geometry;
        geometry.add_polygon({{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}}, "below");
        geometry.add_polygon(
          {{1., 1. + gap}, {2., 1. + gap}, {2., 2.}, {1., 2.}}, "above");
        geometry.add_polygon({{-1., 0.2}, {-gap, 0.2}, {-gap, 0.8}, {-1., 0.8}},
                             "beside");
        bodies =
          std::make_unique<Bodies>(std::move(geometry), one_triangle_each());
        bodies->start(contact_parameters(1e8, reach));
        above = bodies->mesh.block(bodies->mesh.find_element({1.5, 1.5}));
      }

      /// The one above sinks.
      Vector
      sunk_by(const double depth)
      {
        return bodies->interpolate(
          [&](const Point<2> &X, const unsigned int block) {
            return block == above ? Point<2>(0., -depth * (1. + 0.1 * X[0]))
                                  : Point<2>();
          });
      }

      void
      begin_step()
      {
        const Vector begin = sunk_by(0.);
        bodies->contact->detect(begin);
        ContactTimeStep(*bodies->contact).begin(begin, 0.);
        bodies->contact->set_time(h);
      }

      unsigned int
      n_touching() const
      {
        return bodies->contact->report().n_stick +
               bodies->contact->report().n_slip;
      }

      std::unique_ptr<Bodies> bodies;
      unsigned int            above = 0;
    };
  } // namespace Test
} // namespace NMM

#endif
