# Forces of contact over time: along the normals as lines, friction dashed.
#   texts.txt   title, pairs
#   data.txt    pair (from 1), time, force along the normals, friction
load "style.gp"
set title texts[1] noenhanced
set xlabel "time [s]"
set ylabel "force [N]"
shades = "#c8553d #4477aa #228833 #ccbb44 #aa3377 #66ccee #332288 #ee8866 #44aa99 #888888 #882255 #bbcc33"
shown(k, c) = column(1) == k ? column(c) : NaN

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(900, 480) } else { eval png(900, 480) }
  if (lines < 2) {
    set xrange [0 : 1]
    set yrange [0 : 1]
    plot NaN notitle
  } else {
    plot for [k = 2:lines] "data.txt" using (shown(k - 1, 2)):3 with lines lw 2 lc rgb word(shades, k - 1) title texts[k] noenhanced, \
      for [k = 2:lines] "data.txt" using (shown(k - 1, 2)):4 with lines dt 2 lc rgb word(shades, k - 1) notitle
  }
  unset output
}
