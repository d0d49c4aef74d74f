(program screws-3-t24, Grbl 1.1)
(part screws, aluminium, 8 mm thick)
(stock 40.00 x 30.00 x 8 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(drills go 1.50 mm below the stock: leave room under the)
(holes)
(file 3 of 5, load T24 mill-6, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: head-shank: bore)
T24
G54 S11671 M3
G0 X-7.2 Y0
G49
Z5
M8
Z1
G1 Z0 F1750
G3 X-10.8 Y0 Z-0.27 I-1.8 J0 F656
X-7.2 Y0 Z-0.54 I1.8 J0
X-10.8 Y0 Z-0.81 I-1.8 J0
X-7.2 Y0 Z-1.08 I1.8 J0
X-10.8 Y0 Z-1.35 I-1.8 J0
X-7.2 Y0 Z-1.62 I1.8 J0
X-10.8 Y0 Z-1.89 I-1.8 J0
X-7.2 Y0 Z-2.16 I1.8 J0
X-10.8 Y0 Z-2.43 I-1.8 J0
X-7.2 Y0 Z-2.7 I1.8 J0
X-10.8 Y0 Z-2.97 I-1.8 J0
X-7.2 Y0 Z-3.24 I1.8 J0
X-10.8 Y0 Z-3.51 I-1.8 J0
X-7.2 Y0 Z-3.78 I1.8 J0
X-10.8 Y0 Z-4.05 I-1.8 J0
X-7.2 Y0 Z-4.32 I1.8 J0
X-10.8 Y0 Z-4.59 I-1.8 J0
X-7.2 Y0 Z-4.86 I1.8 J0
X-10.8 Y0 Z-5.13 I-1.8 J0
X-7.2 Y0 Z-5.4 I1.8 J0
X-10.8 Y0 I-1.8 J0
X-7.2 Y0 I1.8 J0
G1 X-9 F1750
G0 Z5
(operation: head-shank: finish)
Z1
G1 Z-5.4 F3196
G3 X-7.001 Y0 I1 J0 F1278
X-10.999 Y0 I-1.999 J0
X-7.001 Y0 I1.999 J0
X-9 Y0 I-0.999 J0
X-7.001 Y0 I1 J0
X-10.999 Y0 I-1.999 J0
X-7.001 Y0 I1.999 J0
X-9 Y0 I-0.999 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
