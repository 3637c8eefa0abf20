# This makes the page's files, code.inc last: cmake -D Esbuild=.. -D Source=.. -D Page=.. -P bundle.cmake
# esbuild names chunks by what is in them, so a page never gets another version's. code.inc lists them for
# src/api/files.cc, and index.html has a browser fetch at once what page.js imports.
file(REMOVE_RECURSE "${Page}/code")
set(ENV{NODE_PATH} /usr/share/nodejs)
execute_process(
  COMMAND
    "${Esbuild}" "page=${Source}/page/main.tsx" --bundle --splitting --format=esm --minify --jsx=automatic
    --target=es2020 "--define:process.env.NODE_ENV=\"production\"" --log-level=warning
    --legal-comments=none "--chunk-names=code/[name]-[hash]" "--outdir=${Page}"
    COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${Esbuild}" "${Source}/page/page.css" --minify --log-level=warning
                        "--outfile=${Page}/page.css" COMMAND_ERROR_IS_FATAL ANY)

file(READ "${Page}/page.js" script)
string(REGEX MATCHALL "from\"\\./code/[^\"]+" imports "${script}")
set(preloads "")
foreach(import IN LISTS imports)
  string(REPLACE "from\"./" "/" import "${import}")
  string(APPEND preloads "<link rel=\"modulepreload\" href=\"${import}\">\n")
endforeach()
configure_file("${Source}/page/index.html" "${Page}/index.html" @ONLY)
file(COPY "${Source}/page/icon.svg" "${Source}/openapi.yaml" DESTINATION "${Page}")

file(GLOB code RELATIVE "${Page}" "${Page}/page.js" "${Page}/code/*.js")
execute_process(COMMAND gzip --best --no-name --force --keep ${code} page.css openapi.yaml
                WORKING_DIRECTORY "${Page}" COMMAND_ERROR_IS_FATAL ANY)

set(list "")
set(number 0)
foreach(file IN LISTS code)
  string(APPEND list "CODE(${number}, \"${file}\")\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${Page}/code.inc" "${list}")
