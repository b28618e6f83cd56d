#include <deal.II/base/exceptions.h>

#include <array>
#include <cstdint>
#include <limits>
#include <output/vtu_array.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Two digits of base64 for each of twelve bits.
      std::vector<std::array<char, 2>>
      make_digit_pairs()
      {
        static const char digits[] =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::vector<std::array<char, 2>> pairs(1 << 12);
        for (unsigned int bits = 0; bits < pairs.size(); ++bits)
          pairs[bits] = {{digits[bits >> 6], digits[bits & 63]}};
        return pairs;
      }
    } // namespace


    VtuArrayWriter::VtuArrayWriter(std::ostream &out)
      : out(&out)
      , digit_pairs(make_digit_pairs())
    {
      constexpr int largest_window = 15, most_memory = 9;
      const int     status = deflateInit2(
        &stream, Z_BEST_SPEED, Z_DEFLATED, largest_window, most_memory, Z_RLE);
      AssertThrow(status == Z_OK, dealii::ExcInternalError());
    }


    VtuArrayWriter::~VtuArrayWriter()
    {
      deflateEnd(&stream);
    }


    void
    VtuArrayWriter::write_base64(const unsigned char *bytes,
                                 const std::size_t    n_bytes)
    {
      text.resize((n_bytes + 2) / 3 * 4);
      char      *next = &text[0];
      const auto add  = [&](const unsigned int bits) {
        for (const unsigned int half : {bits >> 12, bits & 4095})
        {
          *next++ = digit_pairs[half][0];
          *next++ = digit_pairs[half][1];
        }
      };
      std::size_t i = 0;
      for (; i + 2 < n_bytes; i += 3)
        add(bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2]);
      if (i < n_bytes)
      {
        const bool has_second = i + 1 < n_bytes;
        add(bytes[i] << 16 | (has_second ? bytes[i + 1] << 8 : 0));
        next[-1] = '=';
        if (!has_second)
          next[-2] = '=';
      }
      out->write(text.data(), text.size());
    }


    void
    VtuArrayWriter::deflate(const unsigned char *bytes,
                            const std::size_t    n_bytes,
                            const int            level)
    {
      deflateReset(&stream);
      deflateParams(&stream, level, Z_RLE);
      // stored blocks have a head of five bytes each
      compressed.resize(deflateBound(&stream, n_bytes) + n_bytes / 1000 + 64);
      stream.next_in   = const_cast<unsigned char *>(bytes);
      stream.avail_in  = n_bytes;
      stream.next_out  = compressed.data();
      stream.avail_out = compressed.size();
      const int status = ::deflate(&stream, Z_FINISH);
      AssertThrow(status == Z_STREAM_END, dealii::ExcInternalError());
    }


    void
    VtuArrayWriter::compress(const unsigned char *bytes,
                             const std::size_t    n_bytes)
    {
      // what a piece from the middle promises
      constexpr std::size_t n_probe = 16384;
      constexpr double      worth   = 0.75;
      if (n_bytes > 4 * n_probe)
      {
        deflate(bytes + n_bytes / 2, n_probe, Z_BEST_SPEED);
        if (stream.total_out > worth * n_probe)
          return deflate(bytes, n_bytes, Z_NO_COMPRESSION);
      }
      deflate(bytes, n_bytes, Z_BEST_SPEED);
    }


    void
    VtuArrayWriter::write_bytes(const std::string   &type,
                                const std::string   &name,
                                const unsigned int   n_components,
                                const unsigned char *bytes,
                                const std::size_t    n_bytes)
    {
      AssertThrow(n_bytes < std::numeric_limits<std::uint32_t>::max(),
                  dealii::ExcInternalError());
      *out << "    <DataArray type=\"" << type << '"';
      if (!name.empty())
        *out << " Name=\"" << name << '"';
      if (n_components > 1)
        *out << " NumberOfComponents=\"" << n_components << '"';
      *out << " format=\"binary\">\n";
      if (n_bytes > 0)
      {
        compress(bytes, n_bytes);
        // one block: their number, sizes of a block and of the last, then compressed
        const auto          size      = static_cast<std::uint32_t>(n_bytes);
        const std::uint32_t header[4] = {
          1, size, size, static_cast<std::uint32_t>(stream.total_out)};
        write_base64(reinterpret_cast<const unsigned char *>(header),
                     sizeof(header));
        write_base64(compressed.data(), stream.total_out);
      }
      *out << "\n    </DataArray>\n";
    }
  } // namespace internal
} // namespace NMM
