# Writes the commit of SOURCE into FILE, "with changes" where files that git knows differ from it.
execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --abbrev=12 "--exclude=*" "--dirty= with changes"
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
set(before)
if(EXISTS ${FILE})
  file(READ ${FILE} before)
endif()
if(NOT commit STREQUAL before)
  file(WRITE ${FILE} "${commit}")
endif()
