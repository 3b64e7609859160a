# Mean error over all tosses against one parameter.
#   texts.txt   title, label of the parameter, label of the errors
#   data.txt    kind (0: point, 1: the scene's value), value, error
load "style.gp"
set title texts[1] noenhanced
set xlabel texts[2] noenhanced
set ylabel texts[3] noenhanced

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot "data.txt" using (column(1) == 0 ? column(2) : NaN):3 with linespoints lc rgb "#c8553d" pt 7 title "mean of all tosses", \
    "data.txt" using (column(1) == 1 ? column(2) : NaN):3 with points lc rgb "#222222" pt 6 ps 2 title "the scene's value"
  unset output
}
