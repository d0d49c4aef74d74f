(program rest-1-t21, Grbl 1.1)
(part rest, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 2, load T21 mill-12, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T21 D 12 mm: mill-12, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: recess: rough)
T21
G54 S5836 M3
G0 X-6.798 Y2.798
G49
Z5
M8
Z1
G1 Z0 F2334
Y-2.798 Z-0.292 F1170
X6.8 Y-2.8 Z-1
Y2.798 Z-1.292
X-6.798 Z-2
Y-2.798 F2334
X6.8 Y-2.8
Y2.798
X-6.798
G0 Z5
M9
M5
G53 G0 Z-2
M30
