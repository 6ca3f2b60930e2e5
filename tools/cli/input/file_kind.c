/* SPDX-License-Identifier: MIT */
/* Files that are no text. */
#include "input/file_kind.h"

#include <stdbool.h>
#include <string.h>

typedef struct {
    const char *bytes;
    size_t size;
    const char *words;
} kind_t;

static bool begins(const char *bytes, size_t size, const kind_t *kind)
{
    return size >= kind->size && memcmp(bytes, kind->bytes, kind->size) == 0;
}

static bool contains(const char *bytes, size_t size, const char *word)
{
    const size_t length = strlen(word);
    for (size_t k = 0; k + length <= size; k++) {
        if (memcmp(bytes + k, word, length) == 0) {
            return true;
        }
    }
    return false;
}

/* Text of two or four bytes a character that does not say so: every other byte of it is zero. */
static const char *wide_text(const char *bytes, size_t size)
{
    bool even = size >= 4;
    bool odd = size >= 4;
    for (size_t k = 0; k < size && k < FILE_KIND_BYTES; k++) {
        const bool zero = bytes[k] == '\0';
        even = even && zero == (k % 2 == 0);
        odd = odd && zero == (k % 2 == 1);
    }
    return (even || odd) ? "this is UTF-16 text; save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8" : NULL;
}

const char *file_kind(const char *bytes, size_t size)
{
    static const kind_t kinds[] = {
        {"\x1F\x8B", 2, "this is compressed with gzip; unpack it: gzip -dc FILE | jointcal ... -"},
        {"BZh", 3, "this is compressed with bzip2; unpack it: bzip2 -dc FILE | jointcal ... -"},
        {"\xFD"
         "7zXZ",
         5, "this is compressed with xz; unpack it: xz -dc FILE | jointcal ... -"},
        {"\x28\xB5\x2F\xFD", 4, "this is compressed with zstd; unpack it: zstd -dc FILE | jointcal ... -"},
        {"7z\xBC\xAF", 4, "this is a 7z archive; unpack it first"},
        {"Rar!", 4, "this is a rar archive; unpack it first"},
        {"\xD0\xCF\x11\xE0", 4, "this is an Excel workbook (xls); save the sheet as CSV"},
        {"\xFF\xFE\0\0", 4, "this is UTF-32 text; save it as UTF-8, or convert it: iconv -f UTF-32 -t UTF-8"},
        {"\xFF\xFE", 2, "this is UTF-16 text; save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8"},
        {"\xFE\xFF", 2, "this is UTF-16 text; save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8"},
        {"\x89HDF", 4, "this is an HDF5 file, as APDM and others write them; export it as CSV"},
        {"MATLAB ", 7, "this is a MATLAB file; write it as CSV: writetable"},
        {"PAR1", 4, "this is a Parquet file; write it as CSV"},
        {"%PDF", 4, "this is a PDF file, not a recording"},
    };
    static const kind_t zip = {"PK\x03\x04", 4, NULL};
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        if (begins(bytes, size, &kinds[k])) {
            return kinds[k].words;
        }
    }
    if (begins(bytes, size, &zip)) {
        if (contains(bytes, size, "xl/") || contains(bytes, size, "[Content_Types]")) {
            return "this is an Excel workbook (xlsx); save the sheet as CSV";
        }
        if (contains(bytes, size, "opendocument.spreadsheet")) {
            return "this is an OpenDocument sheet (ods); save it as CSV";
        }
        return "this is a zip archive; unpack it: unzip -p FILE | jointcal ... -";
    }
    return wide_text(bytes, size);
}
