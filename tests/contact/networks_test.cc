// Blocks between joints that cross at any angle fit each other: at rest, and after
// motions that are small against them, nothing is deep in anything.

#include <contact/contact_model.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  std::unique_ptr<Bodies>
  random_network(std::mt19937 &generator, const unsigned int n_joints)
  {
    std::uniform_real_distribution<double> random(-1., 1.);
    Geometry                               geometry;
    add_box(geometry, {-1., -1.}, {1., 1.});
    for (unsigned int i = 0; i < n_joints; ++i)
    {
      const double   angle = dealii::numbers::PI * random(generator);
      const Point<2> middle(0.8 * random(generator), 0.8 * random(generator));
      const Point<2> along(3. * std::cos(angle), 3. * std::sin(angle));
      geometry.add_polyline({Point<2>(middle - along), middle + along},
                            "joint " + std::to_string(i),
                            CurveRole::joint,
                            JointState::open);
    }
    Bodies::Options options;
    options.cell_size           = 5.;
    options.mesh_of_every_block = true;
    return std::make_unique<Bodies>(std::move(geometry), options);
  }


  // Slivers have their apices at other blocks' corners. The reach is as large as
  // blocks are, so that all faces of a sliver are looked at.
  TEST(ContactNetworks, BlocksThatFitDoNotOverlap)
  {
    constexpr unsigned int seed = 20261122, n_networks = 25;
    constexpr double       motion = 1e-6;
    std::cout << "seed " << seed << '\n';
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(-1., 1.);
    unsigned int                           n_touching = 0;
    for (unsigned int i = 0; i < n_networks; ++i)
    {
      const auto bodies = random_network(generator, 3 + i % 5);
      bodies->start(contact_parameters(1., 0.3));
      std::vector<Tensor<1, 2>> motions(bodies->physical_mesh.n_blocks());
      for (auto &way : motions)
        way = Tensor<1, 2>(
          {motion * random(generator), motion * random(generator)});
      for (const bool moves : {false, true})
      {
        const Vector u =
          bodies->interpolate([&](const Point<2> &, const unsigned int block) {
            return moves ? motions[block] : Tensor<1, 2>();
          });
        bodies->contact->detect(u);
        bodies->contact->assemble(u, false);
        for (const ContactPoint &point : bodies->contact->points())
        {
          if (point.master == invalid_index)
            continue;
          // two blocks move against each other by twice sqrt(2) of it
          EXPECT_GT(point.gap, moves ? -3. * motion : -1e-12)
            << "network " << i << " at " << point.x;
          n_touching += point.gap < 3. * motion;
        }
      }
    }
    // most of them lie on each other
    EXPECT_GT(n_touching, 5000u);
  }
} // namespace
