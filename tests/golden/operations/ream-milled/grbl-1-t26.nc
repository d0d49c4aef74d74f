(program ream-milled-1-t26, Grbl 1.1)
(part ream-milled, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(pin: D6 H7 [0/+0.012], made to 6.006)
(reamers go 1.20 mm below the stock: leave room under the)
(holes)
(file 1 of 2, load T26 mill-4, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T26 D 4 mm: mill-4, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: pin: bore for the reamer)
T26
G54 S12000 M3
G0 X0.887 Y0
G49
Z5
M8
Z1
G1 Z0 F1188
G3 X-0.887 Y0 Z-0.144 I-0.887 J0 F365
X0.887 Y0 Z-0.287 I0.887 J0
X-0.887 Y0 Z-0.43 I-0.887 J0
X0.887 Y0 Z-0.574 I0.887 J0
X-0.887 Y0 Z-0.717 I-0.887 J0
X0.887 Y0 Z-0.86 I0.887 J0
X-0.887 Y0 Z-1.004 I-0.887 J0
X0.887 Y0 Z-1.147 I0.887 J0
X-0.887 Y0 Z-1.29 I-0.887 J0
X0.887 Y0 Z-1.434 I0.887 J0
X-0.887 Y0 Z-1.577 I-0.887 J0
X0.887 Y0 Z-1.72 I0.887 J0
X-0.887 Y0 Z-1.864 I-0.887 J0
X0.887 Y0 Z-2.007 I0.887 J0
X-0.887 Y0 Z-2.15 I-0.887 J0
X0.887 Y0 Z-2.294 I0.887 J0
X-0.887 Y0 Z-2.437 I-0.887 J0
X0.887 Y0 Z-2.58 I0.887 J0
X-0.887 Y0 Z-2.724 I-0.887 J0
X0.887 Y0 Z-2.867 I0.887 J0
X-0.887 Y0 Z-3.01 I-0.887 J0
X0.887 Y0 Z-3.154 I0.887 J0
X-0.887 Y0 Z-3.297 I-0.887 J0
X0.887 Y0 Z-3.44 I0.887 J0
X-0.887 Y0 Z-3.584 I-0.887 J0
X0.887 Y0 Z-3.727 I0.887 J0
X-0.887 Y0 Z-3.87 I-0.887 J0
X0.887 Y0 Z-4.014 I0.887 J0
X-0.887 Y0 Z-4.157 I-0.887 J0
X0.887 Y0 Z-4.3 I0.887 J0
X-0.887 Y0 I-0.887 J0
X0.887 Y0 I0.887 J0
G1 X0 F1188
G0 Z5
M9
M5
G53 G0 Z-2
M30
