# Correct digits of every contestant in every case, from matrix.csv.
#   gnuplot -c matrix.gp MATRIX.csv ROWS COLUMNS OUT
load ARG0[:strstrt(ARG0, "matrix.gp") - 1] . "style.gp"
csv = ARG1
rows = int(ARG2)
columns = int(ARG3)
out = ARG4

set title "Correct digits at the usual step" noenhanced
unset key
unset grid
set xrange [-0.5 : columns - 0.5]
set yrange [rows - 0.5 : -0.5]
set xtics rotate by 45 right noenhanced scale 0
set ytics noenhanced scale 0
set cbrange [0 : 16]
set cblabel "correct digits"
set palette defined (0 "#b2182b", 3 "#ef8a62", 6 "#fddbc7", 9 "#d1e5f0", 12 "#67a9cf", 16 "#2166ac")

do for [kind in "svg png"] {
  width = 300 + 66 * columns
  height = 190 + 22 * rows
  if (kind eq "svg") { eval svg(width, height) } else { eval png(width, height) }
  set lmargin at screen 190.0 / width
  set rmargin at screen 1 - 90.0 / width
  set tmargin at screen 1 - 40.0 / height
  set bmargin at screen 130.0 / height
  plot csv every ::1 using 2:1:(0.5):(0.5):(column(5) >= 0 ? column(5) : NaN):xticlabels(4):yticlabels(3) \
      with boxxyerror fillstyle solid noborder fillcolor palette, \
    csv every ::1 using 2:1:6 with labels font ",9" noenhanced
  unset output
}
