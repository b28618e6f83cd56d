#include "measure.h"

#include <deal.II/base/utilities.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <malloc.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using namespace dealii::Utilities;

      /// Give freed memory back and forget the largest size so far, as far as the system
      /// lets us; returns the size now [MB].
      double
      reset_peak_memory()
      {
        malloc_trim(0);
        std::ofstream("/proc/self/clear_refs") << "5";
        System::MemoryStats memory;
        System::get_memory_stats(memory);
        return memory.VmRSS / 1024.;
      }


      double
      peak_memory()
      {
        System::MemoryStats memory;
        System::get_memory_stats(memory);
        return memory.VmHWM / 1024.;
      }


      template <typename Action>
      void
      for_each_time(const Action &action)
      {
        for (double Row::*member : {&Row::geometry,
                                    &Row::mesh,
                                    &Row::cutting,
                                    &Row::covers,
                                    &Row::quadrature,
                                    &Row::sparsity,
                                    &Row::assembly,
                                    &Row::analysis,
                                    &Row::factorization,
                                    &Row::solution,
                                    &Row::search,
                                    &Row::contact,
                                    &Row::output,
                                    &Row::total})
          action(member);
      }


      void
      print(const Row &row)
      {
        std::cout << std::left << std::setw(20) << row.name;
        for (const std::string &text : {row.method,
                                        row.kinematics,
                                        row.enforcement,
                                        row.stabilization,
                                        row.solver})
          if (!text.empty())
            std::cout << text << ' ';
        std::cout << "p=" << row.degree << " ranks=" << row.ranks << "  "
                  << std::setprecision(8) << row.unknowns << " unknowns  "
                  << std::setprecision(3) << row.total << " s  error "
                  << row.error << " / " << row.second_error << std::endl;
      }
    } // namespace


    Stopwatch::Stopwatch(const MPI_Comm communicator)
      : communicator(communicator)
    {
      MPI_Barrier(communicator);
      timer.restart();
    }


    double
    Stopwatch::lap()
    {
      const double now =
        dealii::Utilities::MPI::max(timer.wall_time(), communicator);
      const double duration = now - last;
      last                  = now;
      return duration;
    }


    double
    Stopwatch::total() const
    {
      return last;
    }


    double
    allocated_memory()
    {
      const struct mallinfo2 info = mallinfo2();
      return (info.uordblks + info.hblkhd) / (1024. * 1024.);
    }


    Recorder::Recorder(const Size size, std::vector<Row> rows)
      : how_much(size)
      , list(std::move(rows))
    {
    }


    Size
    Recorder::size() const
    {
      return how_much;
    }


    void
    Recorder::record(const std::function<Row()> &run)
    {
      // what else the machine does shows in single runs of some seconds
      constexpr unsigned int max_repetitions = 3;
      constexpr double       long_enough = 2., too_long_to_repeat = 10.;
      const double           before = reset_peak_memory();
      dealii::Timer          timer;
      Row                    row = run();
      row.peak_memory =
        dealii::Utilities::MPI::sum(peak_memory(), MPI_COMM_WORLD);
      row.own_peak_memory =
        dealii::Utilities::MPI::sum(peak_memory() - before, MPI_COMM_WORLD);
      const unsigned int repetitions =
        how_much == Size::smallest ? 1 : max_repetitions;
      // all ranks must agree
      const auto elapsed = [&timer]() {
        return dealii::Utilities::MPI::max(timer.wall_time(), MPI_COMM_WORLD);
      };
      while (row.repetitions < repetitions &&
             elapsed() <
               (row.repetitions < 2. ? too_long_to_repeat : long_enough))
      {
        Row again = run();
        for_each_time([&](double Row::*member) {
          row.*member = std::fmin(row.*member, again.*member);
        });
        row.repetitions += 1.;
      }
      add(std::move(row));
    }


    void
    Recorder::add(Row row)
    {
      describe_machine(row);
      row.size  = how_much == Size::full    ? "full"
                  : how_much == Size::quick ? "quick"
                                            : "smallest";
      row.ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      list.push_back(std::move(row));
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        print(list.back());
    }


    const std::vector<Row> &
    Recorder::rows() const
    {
      return list;
    }
  } // namespace Bench
} // namespace NMM
