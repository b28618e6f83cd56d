#include <deal.II/base/utilities.h>

#include <cstdint>
#include <output/double_points.h>
#include <regex>
#include <zlib.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      template <typename Number>
      void
      append(std::vector<unsigned char> &bytes, const Number number)
      {
        const auto *begin = reinterpret_cast<const unsigned char *>(&number);
        // g++ 12 warns of an overflow in insert() where there is none.
        for (std::size_t i = 0; i < sizeof(Number); ++i)
          bytes.push_back(begin[i]);
      }


      /// An array as the others in the file: a head with the number of blocks (1), the sizes of a
      /// block and of the last one, and that of its zlib stream [bytes]; then the stream.
      std::string
      encode(const std::vector<unsigned char> &bytes)
      {
        std::vector<unsigned char> stream(compressBound(bytes.size()));
        uLongf                     size   = stream.size();
        const int                  status = compress2(
          stream.data(), &size, bytes.data(), bytes.size(), Z_NO_COMPRESSION);
        AssertThrow(status == Z_OK, dealii::ExcInternalError());
        stream.resize(size);
        std::vector<unsigned char> head;
        for (const std::size_t number :
             {std::size_t(1), bytes.size(), bytes.size(), stream.size()})
          append(head, static_cast<std::uint32_t>(number));
        return dealii::Utilities::encode_base64(head) +
               dealii::Utilities::encode_base64(stream);
      }
    } // namespace


    std::string
    with_double_points(const std::string                   &vtu,
                       const std::vector<dealii::Point<2>> &points)
    {
      // A file without points stays as it is: deal.II writes no list of them.
      if (points.empty())
        return vtu;
      const std::size_t begin = vtu.find("<Points>"),
                        end   = vtu.find("</Points>");
      AssertThrow(begin != std::string::npos && end != std::string::npos,
                  dealii::ExcInternalError());
      std::vector<unsigned char> bytes;
      bytes.reserve(3 * sizeof(double) * points.size());
      for (const dealii::Point<2> &x : points)
        for (const double coordinate : {x[0], x[1], 0.})
          append(bytes, coordinate);
      return vtu.substr(0, begin) +
             "<Points>\n  <DataArray type=\"Float64\" "
             "NumberOfComponents=\"3\" format=\"binary\">\n" +
             encode(bytes) + "\n  </DataArray>\n" + vtu.substr(end);
    }


    std::string
    with_double_points(const std::string &pvtu)
    {
      return std::regex_replace(pvtu,
                                std::regex(
                                  "(<PPoints>\\s*<PDataArray type=\")Float32"),
                                "$1Float64");
    }
  } // namespace internal
} // namespace NMM
