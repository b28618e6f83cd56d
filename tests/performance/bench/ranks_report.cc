#include "figure.h"
#include "report.h"
#include <algorithm>
#include <cmath>

// The mesh on each rank or a part of it, and where more ranks would lead.
namespace NMM
{
  namespace Bench
  {
    namespace
    {
      /// The first row of that name, method, solver and number of ranks; null if there is none.
      const Row *
      find(const std::vector<Row> &rows,
           const std::string      &name,
           const std::string      &method,
           const std::string      &solver,
           const double            ranks)
      {
        const auto row =
          std::find_if(rows.begin(), rows.end(), [&](const Row &r) {
            return r.name == name && r.method == method && r.solver == solver &&
                   r.ranks == ranks;
          });
        return row == rows.end() ? nullptr : &*row;
      }


      std::string
      name_of(const Row &row)
      {
        return (row.method == "distributed" ? "distributed, "
                                            : "replicated, ") +
               row.solver;
      }


      double
      solver_time(const Row &row)
      {
        return (std::isnan(row.analysis) ? 0. : row.analysis) +
               row.factorization + row.solution;
      }


      /// Time and size of messages between ranks.
      struct Network
      {
        std::string name;
        /// [s], [bytes/s]
        double latency, bandwidth;
      };


      /// Time on many ranks from rows of one and two.
      class Model
      {
      public:
        Model(const Row &one, const Row &two)
          : one(one)
          , two(two)
        {
        }

        /// Exchanges with neighbours in an iteration: of unknowns of second order, and
        /// on each level of ML.
        static constexpr double n_neighbors = 8., n_exchanges = 5.,
                                n_ml_exchanges = 6.;

        /// Of ML: a quarter of the unknowns are of first order, and there is a
        /// level for each factor of nine of these, down to 500.
        double
        n_levels() const
        {
          return 1. + std::ceil(std::log(std::max(one.unknowns / 2000., 1.)) /
                                std::log(9.));
        }

        /// Elements that a rank holds.
        double
        held(const double n) const
        {
          return n == 1. ? one.elements
                         : std::min(one.elements,
                                    one.elements / n +
                                      4. * two.ghost_elements / std::sqrt(n));
        }

        /// [s]
        double
        setup(const double n) const
        {
          const double shared = one.mesh + one.cutting + one.covers +
                                one.quadrature + one.sparsity + one.assembly;
          return one.geometry + shared * held(n) / one.elements +
                 one.factorization / n;
        }

        /// Of one iteration [s].
        double
        iteration(const double n, const Network &network) const
        {
          const double work = one.solution / one.iterations / n;
          if (n == 1.)
            return work;
          const double messages = (n_exchanges + n_ml_exchanges * n_levels()) *
                                  std::min(n_neighbors, n - 1.) *
                                  network.latency;
          // first order has half of the boundary, each level of ML a third of that
          // of the one before
          const double bytes = (n_exchanges + n_ml_exchanges * 0.5 * 1.5) * 4. *
                               two.message_bytes / std::sqrt(n);
          return work + messages + bytes / network.bandwidth +
                 3. * std::log2(n) * network.latency;
        }

        double
        total(const double n, const Network &network) const
        {
          return setup(n) + one.iterations * iteration(n, network);
        }

        double
        speed(const double n, const Network &network) const
        {
          return total(1., network) / total(n, network);
        }

        /// The largest power of two that is used to a half at least.
        double
        end(const Network &network) const
        {
          double n = 1.;
          while (n < 1e6 && speed(2. * n, network) >= n)
            n *= 2.;
          return n;
        }

      private:
        const Row &one, &two;
      };


      void
      write_table(std::ostream &out, const std::vector<Row> &rows)
      {
        out << "| | ranks | unknowns | total [s] | mesh, cutting, covers [s] | "
               "assembly and sparsity [s] | solver [s] | elements held | of "
               "them ghosts | MB |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
        for (const Row &row : rows)
        {
          out << "| " << name_of(row);
          for (const double number : {row.ranks,
                                      row.unknowns,
                                      row.total,
                                      row.mesh + row.cutting + row.covers,
                                      row.assembly + row.sparsity,
                                      solver_time(row),
                                      row.held_elements,
                                      row.ghost_elements,
                                      row.rank_memory})
            out << " | " << text_of(number);
          out << " |\n";
        }
        out << '\n';
      }


      std::vector<Curve>
      make_curves(const std::vector<Row> &rows)
      {
        std::vector<Curve> curves;
        for (const Row &row : rows)
        {
          auto curve =
            std::find_if(curves.begin(), curves.end(), [&](const Curve &c) {
              return c.title == name_of(row);
            });
          if (curve == curves.end())
            curve = curves.insert(curve, {name_of(row), {}});
          curve->points.emplace_back(row.ranks, row.total);
        }
        return curves;
      }


      /// The speed on many ranks if what is shared out were shared out perfectly.
      void
      write_bounds(std::ostream &out, const std::vector<Row> &rows)
      {
        for (const char *solver : {"MUMPS", "CG + ML"})
          if (const Row *row =
                find(rows, "strong scaling", "manifold uniform", solver, 1.))
          {
            const double serial =
              row->geometry + row->mesh + row->cutting + row->covers +
              (std::isnan(row->analysis) ? 0. : row->analysis);
            out << "- " << name_of(*row)
                << ": if what is shared out were shared out perfectly, n ranks "
                   "would be 1 / ("
                << text_of(serial / row->total, 2) << " + "
                << text_of(1. - serial / row->total, 2)
                << " / n) times as fast, never more than "
                << text_of(row->total / serial, 2) << " times.\n";
          }
        out << '\n';
      }


      void
      write_model(std::ostream               &out,
                  const Model                &model,
                  const Row                  &one,
                  const Row                  &two,
                  const std::vector<Network> &networks)
      {
        out
          << "### Many ranks\n\n"
             "A model of the distributed run with conjugate gradients, not a "
             "measurement: times of one rank, ghosts and bytes of two, "
             "messages "
             "of latency l and bandwidth b.\n\n"
             "    T(n) = geometry + (mesh + cutting + covers + quadrature + "
             "sparsity + assembly) H(n)/E\n"
             "           + (making the preconditioner)/n + iterations t(n)\n"
             "    H(n) = E/n + 4 G/sqrt(n)\n"
             "    t(n) = (an iteration on one rank)/n + (5 + 6 L) 8 l + 9.5 * "
             "4 B/sqrt(n) / b + 3 log2(n) l\n\n"
             "E = "
          << text_of(one.elements)
          << " elements, G = " << text_of(two.ghost_elements)
          << " ghost elements, B = " << text_of(two.message_bytes)
          << " bytes of a message, L = " << text_of(model.n_levels())
          << " levels of ML, " << text_of(one.iterations) << " iterations of "
          << text_of(1e3 * one.solution / one.iterations, 3)
          << " ms: each has 5 exchanges with up to 8 neighbours, 6 on each "
             "level, and 3 sums over all ranks.\n\n| times as fast as one rank "
             "|";
        for (double n = 2.; n <= 512.; n *= 4.)
          out << ' ' << n << " ranks |";
        out << " half used up to |\n|---|";
        for (double n = 2.; n <= 512.; n *= 4.)
          out << "---|";
        out << "---|\n";
        for (const Network &network : networks)
        {
          out << "| " << network.name
              << ": l = " << text_of(1e6 * network.latency, 2)
              << " us, b = " << text_of(1e-9 * network.bandwidth, 2)
              << " GB/s |";
          for (double n = 2.; n <= 512.; n *= 4.)
            out << ' ' << text_of(model.speed(n, network), 3) << " |";
          out << ' ' << text_of(model.end(network)) << " ranks |\n";
        }
        const Network &here = networks.front();
        out << "\nOn two ranks the model says "
            << text_of(model.total(2., here), 3) << " s, measured are "
            << text_of(two.total, 3) << " s. At " << text_of(model.end(here))
            << " ranks of the first line a rank's "
            << text_of(one.elements / model.end(here), 3) << " elements have "
            << text_of(model.held(model.end(here)) -
                       one.elements / model.end(here))
            << " ghosts around them, and an iteration's own work takes "
            << text_of(1e6 * one.solution / one.iterations / model.end(here), 3)
            << " us of "
            << text_of(1e6 * model.iteration(model.end(here), here), 3)
            << " us.\n\n";
      }
    } // namespace


    void
    write_distribution(std::ostream           &out,
                       const std::vector<Row> &rows,
                       const std::string      &image_directory)
    {
      const std::vector<Row> strong   = select(rows, "strong scaling"),
                             weak     = select(rows, "weak scaling"),
                             messages = select(rows, "message");
      if (strong.empty() || weak.empty())
        return;
      out << "## Ranks\n\n"
             "`Covers/Distribution = replicated`, the default, shares out "
             "quadrature, assembly, factorization and solution; mesh, cutting "
             "and covers are made by every rank, and the ordering before a "
             "factorization is the first rank's. With `distributed` (in C++ "
             "`make_distributed_mesh()`; linear statics on regular meshes) a "
             "rank also holds only its own cells and five layers around them. "
             "Elements and memory are those of the rank that has most. First "
             "the same ring on more ranks, then as many unknowns for each "
             "rank.\n\n";
      std::vector<Row> all = strong;
      all.insert(all.end(), weak.begin(), weak.end());
      write_table(out, all);
      write_bounds(out, strong);

      const Row *one =
                  find(strong, "strong scaling", "distributed", "CG + ML", 1.),
                *two =
                  find(strong, "strong scaling", "distributed", "CG + ML", 2.);
      Panel strong_panel, weak_panel;
      strong_panel.has_numbers = weak_panel.has_numbers = true;
      strong_panel.x_label = "ranks, the same ring";
      strong_panel.curves  = make_curves(strong);
      weak_panel.x_label   = "ranks, as many unknowns for each";
      weak_panel.curves    = make_curves(weak);
      if (one != nullptr && two != nullptr && messages.size() >= 2)
      {
        const Row                 &small = messages[0], &large = messages[1];
        const std::vector<Network> networks = {
          {"memory of this machine, measured",
           small.total,
           (large.message_bytes - small.message_bytes) /
             std::max(large.total - small.total, 1e-9)},
          {"a network, assumed", 2e-6, 10e9}};
        const Model model(*one, *two);
        write_model(out, model, *one, *two, networks);
        strong_panel.curves.push_back({"model, CG + ML", {}});
        for (double n = 1.; n <= 256.; n *= 2.)
          strong_panel.curves.back().points.emplace_back(
            n, model.total(n, networks.front()));
      }
      draw_curves(image_directory + "/performance-ranks.png",
                  "Rings on ranks",
                  "seconds",
                  {strong_panel, weak_panel});
      out << "![Rings on ranks](images/performance-ranks.png)\n\n";
    }
  } // namespace Bench
} // namespace NMM
