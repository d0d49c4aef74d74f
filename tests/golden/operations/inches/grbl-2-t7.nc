(program inches-2-t7, Grbl 1.1)
(part inches, aluminium, 0.1575 in thick)
(stock 1.5748 x 1.1811 x 0.1575 in, from X-0.78740)
(Y-0.59055)
(origin: axis of the part, Z0 on top of the stock)
(drills go 0.0710 in below the stock: leave room under the)
(holes)
(file 2 of 3, load T7 drill-5, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units inch and)
(inch/min)
(T7 D 0.19685 in: drill-5, drill)
G17 G20 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-0.07874
(operation: drill 5)
T7
G54 S5093 M3
G0 X-0.47244 Y0
G49
Z0.19686
M8
Z0.03938
G1 Z-0.22844 F14.8
G0 Z0.19686
X0.02238 Y-0.00021
Z0.03938
G1 Z-0.22844
G0 Z0.19686
M9
M5
G53 G0 Z-0.07874
M30
