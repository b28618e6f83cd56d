// Blocks that fall into a box and form a heap: time per block and step, where it goes,
// and memory. Argument 1: number of blocks, or several, such as 200,2000, argument 2: cells
// across a block, 0 for a triangle of its own for each, argument 3: duration [s], argument 4:
// the file that two lines are added to, one for the first half of the time, while blocks
// fall, and one for the second, when they lie on each other; argument 5: speed below which
// blocks may sleep [m/s], 0: none does; argument 6: damping in proportion to the stiffness
// [s]; argument 7: rows on each other, however many blocks there are, 0: as many as
// keep the shape of the heap.
//
// A shared machine is up to 1.5 times as fast at one time as at another, and stays so for
// some seconds or minutes. Several heaps are therefore taken forward by turns of a few
// steps each, so that they meet the same times, and what is to be read is the ratio of
// theirs. The largest memory is that of the process: it is told of single heaps.

#include <nmm/base/program.h>
#include <nmm/mechanics/mass_matrix.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <support/contact_bars/moving_bodies.h>
#include <support/coulomb.h>

using namespace NMM;
using namespace NMM::ContactBars;

namespace
{
  constexpr double density = 2500., youngs_modulus = 1e9, time_step = 0.005;
  /// Of blocks at first, and how far their corners are from those of a square [m].
  constexpr double spacing = 1.16, jitter = 0.07;


  /// Processor times of the stages [s].
  struct Stages
  {
    double search = 0., elements = 0., contact = 0., factorization = 0.,
           substitution = 0.;
  };


  /// Of this process [s]: on a machine that others use, too, time on the clock says little.
  double
  processor_time()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }


  /// Adds the processor time of its life to a sum.
  class Stopwatch
  {
  public:
    explicit Stopwatch(double &sum)
      : sum(sum)
      , begin(processor_time())
    {
    }

    Stopwatch(const Stopwatch &) = delete;
    Stopwatch &
    operator=(const Stopwatch &) = delete;

    ~Stopwatch()
    {
      sum += processor_time() - begin;
    }

  private:
    double &sum;
    double  begin;
  };


  class TimedElements : public FiniteSolid
  {
  public:
    TimedElements(FiniteElasticity           &elasticity,
                  const QuadratureCollection &quadrature,
                  Stages                     &stages)
      : FiniteSolid(elasticity, {}, make_mass_matrix(elasticity, quadrature))
      , stages(&stages)
    {
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &forces) override
    {
      const Stopwatch watch(stages->elements);
      return FiniteSolid::assemble(trial, forces);
    }

  private:
    Stages *stages;
  };


  class TimedContact : public ContactTerm
  {
  public:
    TimedContact(const ModelLayout &layout, Contact &contact, Stages &stages)
      : ContactTerm(layout, contact)
      , stages(&stages)
    {
    }

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override
    {
      const Stopwatch watch(stages->contact);
      return ContactTerm::assemble(trial, sum);
    }

    void
    begin_step(const StepBegin &step) override
    {
      const Stopwatch watch(stages->search);
      ContactTerm::begin_step(step);
    }

  private:
    Stages *stages;
  };


  /// Convex quadrilaterals, nearly squares of 1 m, in rows above the floor, every other
  /// row half a block to the right; the box's width and the heap's height.
  Geometry
  blocks(const unsigned int n,
         const unsigned int n_rows,
         double            &width,
         double            &height)
  {
    std::mt19937                           generator(6);
    std::uniform_real_distribution<double> random(-1., 1.);
    const unsigned int                     n_columns =
      n_rows > 0 ? (n + n_rows - 1) / n_rows : std::floor(std::sqrt(3.2 * n));
    Geometry     geometry;
    unsigned int row = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      row = i / n_columns;
      const Tensor<1, 2> center =
        Point<2>(spacing * (i % n_columns + (row % 2 == 0 ? 0.5 : 1.)),
                 spacing * (row + 0.5));
      std::vector<Point<2>> corners;
      for (const auto &[x, y] : {std::make_pair(-0.5, -0.5),
                                 std::make_pair(0.5, -0.5),
                                 std::make_pair(0.5, 0.5),
                                 std::make_pair(-0.5, 0.5)})
        corners.push_back(Point<2>(x + jitter * random(generator),
                                   y + jitter * random(generator)) +
                          center);
      add_block(geometry, "block " + std::to_string(i), corners);
    }
    width  = (n_columns + 0.5) * spacing;
    height = (row + 1) * spacing;
    return geometry;
  }


  double
  peak_memory()
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    return static_cast<double>(stats.VmHWM);
  }


  /// What happened in a part of the time.
  struct Phase
  {
    std::string name;
    double      end = 0., seconds = 0., n_steps = 0., n_iterations = 0.,
           n_full_iterations = 0., n_cuts = 0., n_points = 0., n_pairs = 0.,
           n_patterns = 0., n_asleep = 0., overlap = 0.;
    Stages stages;
  };


  struct Heap
  {
    Heap(unsigned int n_blocks,
         double       n_cells,
         double       sleep_speed,
         double       stiffness_damping,
         unsigned int n_rows);

    /// Steps until @p end, which are added to @p phase.
    void
    run(Phase &phase, double end);

    /// @p memory: of the process, per block [kB]; @p n_heaps: by turns.
    void
    write(const Phase  &phase,
          double        memory,
          std::size_t   n_heaps,
          std::ostream &csv) const;

    unsigned int                  n_blocks, n_rows;
    double                        n_cells, sleep_speed, stiffness_damping;
    Stages                        stages;
    std::unique_ptr<MovingBodies> bodies;
    double energy = 0., last = 0., gain = 0., largest_kinetic = 0.;
  };


  Heap::Heap(const unsigned int n_blocks,
             const double       n_cells,
             const double       sleep_speed,
             const double       stiffness_damping,
             const unsigned int n_rows)
    : n_blocks(n_blocks)
    , n_rows(n_rows)
    , n_cells(n_cells)
    , sleep_speed(sleep_speed)
    , stiffness_damping(stiffness_damping)
  {
    double                width, height;
    Geometry              geometry = blocks(n_blocks, n_rows, width, height);
    MovingBodies::Options options;
    options.cell_size           = n_cells > 0. ? 1. / n_cells : 2.5;
    options.mesh_of_every_block = n_cells == 0.;
    options.obstacles           = {obstacle(
      "box", {{width, 2. * height}, {width, 0.}, {0., 0.}, {0., 2. * height}})};
    bodies = std::make_unique<MovingBodies>(std::move(geometry), options);
    bodies->problem.materials = {
      material("rock", youngs_modulus, 0.2, density)};
    bodies->problem.gravity = Tensor<1, 2>({0., -standard_gravity});
    ContactParameters parameters =
      contact_parameters(10. * youngs_modulus, 0.05);
    coulomb(parameters).friction       = std::tan(degrees(30.));
    coulomb(parameters).normal_damping = coulomb(parameters).shear_damping =
      0.2 * std::sqrt(coulomb(parameters).normal_stiffness * density * 0.5);
    static_cast<Bodies &>(*bodies).start(parameters,
                                         /* is_linearized = */ false);
    bodies->solid = std::make_unique<TimedElements>(*bodies->elasticity,
                                                    bodies->quadrature,
                                                    stages);
    const ModelLayout &layout = bodies->solid->layout();
    bodies->touch =
      std::make_unique<TimedContact>(layout, *bodies->contact, stages);
    bodies->model = std::make_unique<MechanicalModel>(
      layout,
      std::vector<ForceTerm *>{bodies->solid.get(), bodies->touch.get()});
    RayleighDamping damping;
    damping.stiffness = stiffness_damping;
    bodies->integrate(TimeScheme::energy_momentum(), damping);
    if (sleep_speed > 0.)
    {
      SleepParameters sleep;
      sleep.speed = sleep_speed;
      bodies->integrator->let_blocks_sleep(sleep);
    }
  }


  void
  Heap::run(Phase &phase, const double end)
  {
    // overlaps are those of all against all
    constexpr unsigned int steps_between = 25;

    phase.end = end;
    StepControlParameters control;
    control.initial_step = time_step;
    control.min_step     = 1e-4 * time_step;
    StepRecord   record;
    unsigned int version = bodies->contact->pattern_version();
    stages               = phase.stages;
    bool goes_on         = true;
    while (goes_on)
    {
      const double  begin = processor_time();
      dealii::Timer timer;
      goes_on = StepControl(control).advance(*bodies->integrator, end, record);
      if (!goes_on)
        break;
      const double seconds = processor_time() - begin;
      // Newton's method measures on the clock
      const double share = seconds / timer.wall_time();
      phase.seconds += seconds;
      phase.n_steps += 1.;
      phase.n_cuts += record.n_cuts;
      phase.n_iterations +=
        record.report.n_iterations + record.n_lost_iterations;
      phase.n_full_iterations += record.report.n_full_iterations;
      phase.n_asleep += bodies->integrator->n_asleep();
      stages.factorization += share * record.report.factorization_time;
      stages.substitution += share * record.report.substitution_time;
      phase.n_patterns += bodies->contact->pattern_version() != version;
      version = bodies->contact->pattern_version();

      std::set<std::pair<unsigned int, unsigned int>> pairs;
      const auto &edges = bodies->surface.edges();
      for (const ContactPoint &point : bodies->contact->points())
        if (point.state != ContactState::open)
        {
          phase.n_points += 1.;
          pairs.insert(
            std::minmax(edges[point.edge].body, edges[point.master].body));
        }
      phase.n_pairs += pairs.size();

      const Account &account = bodies->integrator->account();
      const double now = account.kinetic + account.strain + account.conditions -
                         account.external_work;
      gain            = std::max(gain, now - last);
      last            = now;
      largest_kinetic = std::max(largest_kinetic, account.kinetic);
      if (static_cast<unsigned int>(phase.n_steps) % steps_between == 0)
        phase.overlap =
          std::max(phase.overlap, bodies->surface.largest_overlap());
    }
    phase.stages = stages;
  }


  constexpr const char *head =
    "blocks,elements_per_block,unknowns_per_block,phase,end_s,steps,cuts,"
    "iterations_per_step,iterations_per_block_and_step,new_patterns_per_step,"
    "block_steps_per_s,"
    "us_per_block_and_step,search_us,contact_us,elements_us,factorization_us,"
    "substitution_us,rest_us,touching_points_per_block,touching_pairs_per_"
    "block,"
    "us_per_touching_point_and_step,memory_kB_per_block,largest_overlap_m,"
    "energy_gained,kinetic_energy,sleep_speed_m_per_s,"
    "stiffness_damping_s,share_asleep,rows,heaps\n";


  void
  Heap::write(const Phase      &phase,
              const double      memory,
              const std::size_t n_heaps,
              std::ostream     &csv) const
  {
    const double  n            = n_blocks;
    const double  microseconds = 1e6 / (n * phase.n_steps);
    const Stages &s            = phase.stages;
    const double  known =
      s.search + s.contact + s.elements + s.factorization + s.substitution;
    csv.precision(4);
    csv << n << ',' << bodies->mesh.n_elements() / n << ','
        << 2 * bodies->covers.n_covers() / n << ',' << phase.name << ','
        << phase.end << ',' << phase.n_steps << ',' << phase.n_cuts << ','
        << phase.n_iterations / phase.n_steps << ','
        << phase.n_full_iterations / phase.n_steps << ','
        << phase.n_patterns / phase.n_steps << ','
        << n * phase.n_steps / phase.seconds;
    for (const double seconds : {phase.seconds,
                                 s.search,
                                 s.contact,
                                 s.elements,
                                 s.factorization,
                                 s.substitution,
                                 phase.seconds - known})
      csv << ',' << microseconds * seconds;
    csv << ',' << phase.n_points / (n * phase.n_steps) << ','
        << phase.n_pairs / (n * phase.n_steps) << ','
        << 1e6 * phase.seconds / phase.n_points << ',' << memory << ','
        << std::max(phase.overlap, bodies->surface.largest_overlap()) << ','
        << gain / largest_kinetic << ','
        << bodies->integrator->account().kinetic / largest_kinetic << ','
        << sleep_speed << ',' << stiffness_damping << ','
        << phase.n_asleep / (n * phase.n_steps) << ',' << n_rows << ','
        << n_heaps << '\n';
  }
} // namespace


int
main(int argc, char **argv)
{
  constexpr unsigned int steps_of_turn = 20;

  const NMM::MPISession mpi(argv[0]);
  const auto            argument = [&](const int i, const double otherwise) {
    return argc > i ? std::stod(argv[i]) : otherwise;
  };
  const std::vector<int> n_blocks = dealii::Utilities::string_to_int(
    dealii::Utilities::split_string_list(argc > 1 ? argv[1] : "20"));
  const double n_cells = argument(2, 0.), duration = argument(3, 2.),
               sleep_speed = argument(5, 0.), damping = argument(6, 0.);
  const unsigned int n_rows = argc > 7 ? std::stoi(argv[7]) : 0;

  const double                       memory_before = peak_memory();
  std::vector<std::unique_ptr<Heap>> heaps;
  for (const int n : n_blocks)
    heaps.push_back(
      std::make_unique<Heap>(n, n_cells, sleep_speed, damping, n_rows));
  std::ostringstream lines;
  double             time = 0.;
  for (const auto &[name, end] : {std::make_pair("falls", 0.5 * duration),
                                  std::make_pair("lies", duration)})
  {
    std::vector<Phase> phases(heaps.size());
    while (time < end)
    {
      time += steps_of_turn * time_step;
      if (heaps.size() == 1 || time > end - time_step)
        time = end;
      for (unsigned int i = 0; i < heaps.size(); ++i)
        heaps[i]->run(phases[i], time);
    }
    for (unsigned int i = 0; i < heaps.size(); ++i)
    {
      phases[i].name = name;
      heaps[i]->write(phases[i],
                      heaps.size() == 1
                        ? (peak_memory() - memory_before) / n_blocks[0]
                        : std::numeric_limits<double>::quiet_NaN(),
                      heaps.size(),
                      lines);
    }
    std::cout << name << " done" << std::endl;
  }
  std::cout << head << lines.str();
  if (argc > 4)
  {
    const bool is_new = !std::filesystem::exists(argv[4]);
    std::ofstream(argv[4], std::ios::app)
      << (is_new ? head : "") << lines.str();
  }
}
